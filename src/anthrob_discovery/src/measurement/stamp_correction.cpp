#include "measurement/stamp_correction.h"

#include <cmath>
#include <set>
#include <utility>

#include "measurement/controller_algebra.h"
#include "measurement/law_correction.h"
#include "measurement/stamp_report.h"

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
      report_shift(*shift, description);
      description.remarks.back() += " (" + recording->folder + ", but not all recordings)";
    }
    correct(robot, *shift, *recording, description);
  }
}

/// One shift that all recordings share.
void correct_shift(const RobotModel& robot, const ControllerAlgebra& algebra,
                   const StampShift& shift, Description& description) {
  report_shift(shift, description);
  const std::vector<Dataset*> recordings = recordings_of(description.question);
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    if (algebra.helps(shift, r)) correct(robot, shift, *recordings[r], description);
  }
}

}  // namespace

void correct_controller_stamps(const RobotModel& robot, const ConfigNode& config,
                               Description& description) {
  Question& question = description.question;
  const ControllerAlgebraOptions& options = question.options.measurement.controller;
  const std::vector<Dataset*> recordings = recordings_of(question);
  const auto as_they_are = [&] {
    return ControllerAlgebra(robot, {recordings.begin(), recordings.end()}, options);
  };
  std::set<LateStamp> corrected;
  bool is_other_law = false;
  std::optional<StampShift> rest;  // that rounding to ticks left of the last one
  for (;;) {
    const ControllerAlgebra algebra = as_they_are();
    if (!algebra.is_known()) return;
    const auto shift = algebra.stamp_shift();
    if (const auto law = other_law(algebra, shift ? shift : rest)) {
      if (is_other_law) break;
      if (!go_on_by_other_law(robot, config, *law, description)) return;
      is_other_law = true;
      continue;
    }
    // Measurements may be late, and voltages logged after the tick.
    if (!shift || !corrected.insert(shift->what).second) break;
    correct_shift(robot, algebra, *shift, description);
    if (shift->what == LateStamp::kReference) break;
    rest = shift;
    rest->late = 0.0;
  }
  if (corrected.empty() && !is_other_law)
    correct_one_by_one(robot, recordings, options, description);
  remark_on_voltages(as_they_are(), {}, description);
}

}  // namespace discovery
}  // namespace anthrob
