#include "measurement/measurement.h"

#include <algorithm>

#include "measurement/clock_correction.h"
#include "measurement/column_correction.h"
#include "measurement/counts.h"
#include "measurement/current_correction.h"
#include "measurement/hold_correction.h"
#include "measurement/replays.h"
#include "measurement/stamp_correction.h"
#include "measurement/statements.h"

namespace anthrob {
namespace discovery {

namespace {

bool follows_another_law(const Measurement& measurement) {
  return std::any_of(measurement.begin(), measurement.end(),
                     [](const MeasurementProperty& row) { return row.what == "controller"; });
}

}  // namespace

Description as_stated(const RobotModel& robot, const Question& question) {
  Description description;
  description.question = question;
  correct_as_stated(robot, description);
  return description;
}

Description describe(const Evaluator& evaluator, Description description) {
  const RobotModel& robot = *evaluator.model();
  correct_columns(robot, description);
  correct_holds(robot, description);
  std::vector<MovedTable> moved;
  correct_clock_offsets(robot, false, moved, description);
  auto simulated =
      replays(evaluator, recordings_of(description.question), description.question.feed);
  correct_columns_by_model(robot, simulated, description);
  // A joint in other units may have seemed to rest.
  correct_clock_offsets(robot, true, moved, description);
  correct_controller_stamps(robot, evaluator.description().config(), description);
  // Under the model's law, motors come earlier or later than under the robot's.
  if (follows_another_law(description.measurement)) {
    simulated = replays(evaluator, recordings_of(description.question), description.question.feed);
  }
  correct_clocks(robot, simulated, moved, description);
  correct_currents(robot, description);
  report_counts(robot, description);
  tell_contradictions(description);
  return description;
}

}  // namespace discovery
}  // namespace anthrob
