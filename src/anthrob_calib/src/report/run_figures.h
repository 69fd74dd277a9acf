#pragma once

#include <optional>
#include <string>

#include "calibration/calibration_outcome.h"

namespace anthrob {
namespace calibration {

/// Errors of all runs, before and after: of each joint, and of the muscles' forces with the least
/// and the largest (Figs 8.2 to 8.11).
std::string errors_figure(const BeforeAfter& both, const RobotModel& model,
                          const std::string& title);

/// One trajectory over time, measured and simulated (Figs 8.12 to 8.16).
/// @param both with `after`   @param r of its runs
std::string trajectory_figure(const BeforeAfter& both, std::size_t r, const RobotModel& model);

/// The trajectory with the largest error of a joint after the calibration, over the mean of that
/// joint. @return nothing if there is none
std::optional<std::size_t> worst_trajectory(const BeforeAfter& both, const RobotModel& model);

}  // namespace calibration
}  // namespace anthrob
