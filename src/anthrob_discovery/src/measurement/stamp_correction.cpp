#include "measurement/stamp_correction.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "anthrob_core/text.h"
#include "measurement/controller_algebra.h"
#include "measurement/retimed.h"

namespace anthrob {
namespace discovery {

namespace {

std::vector<std::string> quantities_of(LateStamp what) {
  switch (what) {
    case LateStamp::kVoltage:
      return {"voltage"};
    case LateStamp::kPosition:
      return {"position", "velocity"};
    case LateStamp::kForce:
      return {"force"};
    case LateStamp::kMeasured:
      return {"position", "velocity", "force"};
    case LateStamp::kReference:
      break;
  }
  return {};
}

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

/// Moves these quantities of all muscles, wherever they are recorded.
void move_earlier(const RobotModel& robot, const std::vector<std::string>& quantities, double late,
                  Dataset& recording) {
  const auto shift = static_cast<Nanoseconds>(std::llround(1e9 * late));
  for (std::size_t k = 0, count = recording.tables.size(); k < count; ++k) {
    const Table& table = recording.tables[k];
    if (table.name == "commands") continue;
    std::vector<std::string> columns;
    for (const Column& column : table.columns) {
      if (robot.find_muscle(column.owner()) >= 0 &&
          std::find(quantities.begin(), quantities.end(), column.quantity()) != quantities.end()) {
        columns.push_back(column.name);
      }
    }
    if (columns.empty()) continue;
    TimesTaken times;
    for (const Nanoseconds t : table.t) times.emplace_back(t - shift);
    retime(recording, std::string(table.name), columns,
           table.name + " of " + quantities.front() + "s", times);
  }
}

bool is_after_tick(const StampShift& shift) {
  return shift.what == LateStamp::kVoltage && std::lround(shift.late / shift.tick) == -1;
}

void report_shift(const StampShift& shift, double sigmas, Description& description) {
  const std::string kind = kind_word(shift.what);
  const double tick = shift.tick, half = sigmas * shift.sigma;
  if (is_after_tick(shift)) {
    description.measurement.push_back(
        {kind, "all", "tick_phase", 0.0, {-half / tick, half / tick}, "tick", "found"});
    description.remarks.push_back(
        "all of kind voltage: logged after the controller's tick, not before it as by the model's "
        "sensors: moved by one tick (" +
        short_number(1000.0 * tick) + " ms)");
    return;
  }
  description.measurement.push_back(
      {kind, "all", "delay", shift.late, {shift.late - half, shift.late + half}, "s", "found"});
  const std::string by = significant(1000.0 * std::abs(shift.late), 3) + " ms too " +
                         (shift.late > 0.0 ? "late" : "early");
  description.remarks.push_back(
      "all of kind " + kind + ": stamped " + by +
      " for the controllers' law, by which references and measurements give the voltages" +
      (shift.what == LateStamp::kReference ? "; left as they are" : ": moved by as much"));
}

void correct(const RobotModel& robot, const StampShift& shift, Dataset& recording,
             Description& description) {
  if (shift.what == LateStamp::kReference) return;
  move_earlier(robot, quantities_of(shift.what), shift.late, recording);
  description.corrected = true;
}

/// Of recordings that were not taken alike, as of a robot and of its simulation. The first of each
/// shift is reported.
void correct_one_by_one(const RobotModel& robot, const std::vector<Dataset*>& recordings,
                        const ControllerAlgebraOptions& options, Description& description) {
  std::set<std::pair<LateStamp, long>> reported;
  for (Dataset* recording : recordings) {
    const auto shift = ControllerAlgebra(robot, {recording}, options).stamp_shift();
    if (!shift) continue;
    if (reported.emplace(shift->what, std::lround(shift->late / shift->tick)).second) {
      report_shift(*shift, options.interval, description);
      description.remarks.back() += " (" + recording->folder + ", but not all recordings)";
    }
    correct(robot, *shift, *recording, description);
  }
}

}  // namespace

void correct_controller_stamps(const RobotModel& robot, Description& description) {
  Question& question = description.question;
  const ControllerAlgebraOptions& options = question.options.measurement.controller;
  std::vector<Dataset*> recordings;
  for (auto* group : {&question.train, &question.test, &question.repeats}) {
    for (Dataset& recording : *group) recordings.push_back(&recording);
  }
  const ControllerAlgebra algebra(robot, {recordings.begin(), recordings.end()}, options);
  if (!algebra.is_known()) return;
  const auto shift = algebra.stamp_shift();
  if (shift) {
    report_shift(*shift, options.interval, description);
    for (std::size_t r = 0; r < recordings.size(); ++r) {
      if (algebra.helps(*shift, r)) correct(robot, *shift, *recordings[r], description);
    }
  } else {
    correct_one_by_one(robot, recordings, options, description);
  }
  const double left = algebra.left(shift);
  if (left > options.other_law) {
    description.remarks.push_back(
        "under the model's control law, recorded references and measurements do not give the "
        "recorded voltages: they differ by " +
        significant(left, 2) +
        " times the noise of the voltages; another law, other gains, or something that is late");
  }
}

}  // namespace discovery
}  // namespace anthrob
