#pragma once

#include <memory>
#include <vector>

#include "anthrob_calib/calibration/measured_run.h"
#include "anthrob_calib/calibration/parameter_space.h"
#include "anthrob_calib/calibration/run_simulation.h"

namespace anthrob {
namespace calibration {

/// What is to be made small: a model with free parameters, runs of the robot, and weights. Knows no
/// optimiser. All members may be called from many threads at once.
class Problem {
 public:
  Problem(ConfigNode model, ParameterSpace space, std::vector<MeasuredRun> runs, Weights weights,
          SimulationOptions options);

  const ParameterSpace& space() const { return space_; }
  const std::vector<MeasuredRun>& runs() const { return runs_; }
  const Weights& weights() const { return weights_; }
  const SimulationOptions& options() const { return options_; }

  /// @throws BadInput if the parameters make no valid model (a path point inside a surface)
  std::shared_ptr<const RobotModel> build(const std::vector<double>& values) const;

  /// F_S or F_D: the mean over runs; infinite for an invalid individual, one whose model cannot be
  /// built or whose motion is no longer finite.
  double fitness(const std::vector<double>& values) const;
  /// Numbers whose squares add up to the fitness; empty for an invalid individual.
  std::vector<double> residuals(const std::vector<double>& values) const;

 private:
  template <class Function>
  bool try_simulate(const std::vector<double>& values, Function use) const;

  ConfigNode model_;
  ParameterSpace space_;
  std::vector<MeasuredRun> runs_;
  Weights weights_;
  SimulationOptions options_;
};

}  // namespace calibration
}  // namespace anthrob
