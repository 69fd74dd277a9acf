#include "measurement/stamp_report.h"

#include <algorithm>
#include <cmath>

#include "anthrob_core/text.h"
#include "measurement/column_edits.h"

namespace anthrob {
namespace discovery {

namespace {

double interval_of(const Description& description) {
  return description.question.options.measurement.controller.interval;
}

}  // namespace

std::string kind_word(LateStamp what) {
  switch (what) {
    case LateStamp::kVoltage:
      return "voltage";
    case LateStamp::kPosition:
      return "position";
    case LateStamp::kForce:
      return "force";
    case LateStamp::kMeasured:
      return "position and force";
    case LateStamp::kReference:
      break;
  }
  return "reference";
}

void move_earlier(const RobotModel& robot, const std::vector<std::string>& quantities, double late,
                  Dataset& recording) {
  move_columns(
      recording,
      [&](const Column& column) {
        return robot.find_muscle(column.owner()) >= 0 &&
               std::find(quantities.begin(), quantities.end(), column.quantity()) !=
                   quantities.end();
      },
      late);
}

void report_tick_phase(double tick, double sigma, Description& description) {
  const double half = interval_of(description) * sigma;
  description.measurement.push_back(
      {"voltage", "all", "tick_phase", 0.0, {-half / tick, half / tick}, "tick", "found"});
  description.remarks.push_back(
      "all of kind voltage: logged after the controller's tick, not before it as by the model's "
      "sensors: moved by one tick (" +
      short_number(1000.0 * tick) + " ms)");
}

void report_shift(const StampShift& shift, Description& description) {
  if (shift.what == LateStamp::kVoltage && std::lround(shift.late / shift.tick) == -1) {
    report_tick_phase(shift.tick, shift.sigma, description);
    return;
  }
  const std::string kind = kind_word(shift.what);
  const double half = interval_of(description) * shift.sigma;
  description.measurement.push_back(
      {kind, "all", "delay", shift.late, {shift.late - half, shift.late + half}, "s", "found"});
  const std::string by = significant(1000.0 * std::abs(shift.late), 3) + " ms too " +
                         (shift.late > 0.0 ? "late" : "early");
  description.remarks.push_back(
      "all of kind " + kind + ": stamped " + by +
      " for the controllers' law, by which references and measurements give the voltages" +
      (shift.what == LateStamp::kReference ? "; left as they are" : ": moved by as much"));
}

}  // namespace discovery
}  // namespace anthrob
