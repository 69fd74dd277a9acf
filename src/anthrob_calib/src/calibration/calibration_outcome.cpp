#include "calibration/calibration_outcome.h"

#include <algorithm>
#include <cstdio>
#include <numeric>

namespace anthrob {
namespace calibration {

std::vector<std::string> insensitive_parameters(const CalibrationOutcome& outcome) {
  constexpr double kNothing = 1e-6;  // of what the parameter that tells most does
  std::vector<std::string> names;
  const std::vector<double>& sensitivity = outcome.sensitivity;
  if (sensitivity.empty()) return names;
  const double most = *std::max_element(sensitivity.begin(), sensitivity.end());
  for (std::size_t i = 0; i < sensitivity.size(); ++i) {
    if (sensitivity[i] <= kNothing * most) names.push_back(outcome.parameters[i].name());
  }
  return names;
}

bool is_at_bound(const CalibrationOutcome& outcome, std::size_t parameter) {
  const ModelParameter& p = outcome.parameters[parameter];
  const double edge = 1e-6 * p.range(), value = outcome.best[parameter];
  return value - p.lower < edge || p.upper - value < edge;
}

std::optional<std::string> too_early(const CalibrationOutcome& outcome) {
  constexpr double kMuch = 0.25;
  if (outcome.moves_on <= kMuch * outcome.fitness) return std::nullopt;
  char text[320];
  std::snprintf(
      text, sizeof(text),
      "equilibria are compared after %g s of motion, but the simulated arm moves on until "
      "the recordings end: by %.3g in the measure of the fitness, which is %.3g; what is "
      "fitted so may be wrong; expected a longer simulate.motion",
      outcome.simulation.motion, outcome.moves_on, outcome.fitness);
  return text;
}

MeanErrors run_errors(const RunDifferences& run, const RobotModel& model) {
  MeanErrors errors;
  const Differences& d = run.shown();
  for (const JointModel& joint : model.skeleton->joints) {
    const std::vector<double> error = d.joint_error(joint);
    errors.joints.push_back(std::accumulate(error.begin(), error.end(), 0.0) / d.count());
  }
  errors.force = d.force.cwiseAbs().mean();
  return errors;
}

MeanErrors mean_errors(const std::vector<RunDifferences>& runs, const RobotModel& model) {
  MeanErrors mean;
  mean.joints.assign(model.skeleton->joints.size(), 0.0);
  for (const RunDifferences& run : runs) {
    const MeanErrors errors = run_errors(run, model);
    for (std::size_t j = 0; j < mean.joints.size(); ++j) {
      mean.joints[j] += errors.joints[j] / static_cast<double>(runs.size());
    }
    mean.force += errors.force / static_cast<double>(runs.size());
  }
  return mean;
}

}  // namespace calibration
}  // namespace anthrob
