#include "measurement/current_correction.h"

#include <cmath>

#include "anthrob_core/text.h"
#include "measurement/column_edits.h"
#include "measurement/expected_current.h"
#include "measurement/lag_fit.h"
#include "measurement/stamp_report.h"

namespace anthrob {
namespace discovery {

namespace {

std::vector<LaggingPair> currents_of(const RobotModel& robot,
                                     const std::vector<Dataset*>& recordings,
                                     const MeasurementOptions& options) {
  std::vector<LaggingPair> pairs;
  for (const Dataset* recording : recordings) {
    for (const MuscleModel& muscle : robot.muscles) {
      LaggingPair pair{recording->series(muscle.name + "/current"),
                       expected_current(muscle, *recording, options.column.beside)};
      if (!pair.measured.empty() && !pair.expected.empty()) pairs.push_back(std::move(pair));
    }
  }
  return pairs;
}

}  // namespace

void correct_currents(const RobotModel& robot, Description& description) {
  const MeasurementOptions& options = description.question.options.measurement;
  const std::vector<Dataset*> recordings = recordings_of(description.question);
  const std::vector<LaggingPair> pairs = currents_of(robot, recordings, options);
  const auto lag = fit_lag(pairs, options.controller.longest, options.clock);
  // Where the voltage changes within a tick is not known.
  double tick = 0.0;
  for (const MuscleModel& muscle : robot.muscles) tick = std::max(tick, muscle.controller.period);
  if (!lag || std::abs(lag->late) < tick + options.clock.sure * lag->sigma) return;
  const auto filter = fit_filter(pairs, options.controller.longest, options.clock);
  const bool is_filter = filter && filter->squares < lag->squares;
  const LagFit& found = is_filter ? *filter : *lag;
  const double half = options.clock.interval * std::hypot(found.sigma, tick / std::sqrt(12.0));
  description.measurement.push_back({"current",
                                     "all",
                                     is_filter ? "filter" : "delay",
                                     found.late,
                                     {found.late - half, found.late + half},
                                     "s",
                                     "found"});
  description.remarks.push_back(
      "all of kind current: " +
      (is_filter ? "filtered with a time constant of " + short_number(1000.0 * found.late) +
                       " ms beside what voltages and velocities give: undone"
                 : significant(1000.0 * std::abs(found.late), 2) + " ms " +
                       (found.late > 0.0 ? "later" : "earlier") +
                       " than voltages and velocities have them (delayed or averaged): moved by "
                       "it"));
  for (Dataset* recording : recordings) {
    if (is_filter) {
      undo_filters(
          *recording,
          [&](const Column& column) {
            return robot.find_muscle(column.owner()) >= 0 && column.quantity() == "current";
          },
          found.late);
    } else {
      move_earlier(robot, {"current"}, found.late, *recording);
    }
  }
  description.corrected = true;
}

}  // namespace discovery
}  // namespace anthrob
