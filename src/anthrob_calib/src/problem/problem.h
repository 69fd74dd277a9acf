#pragma once

#include <memory>
#include <vector>

#include "problem/measured_run.h"
#include "problem/parameter_space.h"
#include "problem/run_simulation.h"

namespace anthrob {
namespace calibration {

/// The function to minimise: a model with free parameters, runs of the robot, and weights. It does
/// not depend on the optimiser. All members may be called from several threads at once.
class Problem {
 public:
  /// @param model its files are read here, and never again
  Problem(const ConfigNode& model, ParameterSpace space, std::vector<MeasuredRun> runs,
          Weights weights, SimulationOptions options);

  const ParameterSpace& space() const { return space_; }
  const std::vector<MeasuredRun>& runs() const { return runs_; }
  const Weights& weights() const { return weights_; }
  const SimulationOptions& options() const { return options_; }

  /// @throws BadInput if the parameters make no valid model (a path point inside a surface)
  std::shared_ptr<const RobotModel> build(const std::vector<double>& values) const;

  /// F_S (5.9) or F_D (5.20): the mean over runs. Infinite for an invalid individual: its model
  /// cannot be built, or its motion does not stay finite.
  double fitness(const std::vector<double>& values) const;
  /// Numbers whose squares add up to the fitness; empty for an invalid individual.
  std::vector<double> residuals(const std::vector<double>& values) const;

 private:
  template <class Function>
  bool try_simulate(const std::vector<double>& values, Function use) const;

  RobotDescription model_;
  ParameterSpace space_;
  std::vector<MeasuredRun> runs_;
  Weights weights_;
  SimulationOptions options_;
};

}  // namespace calibration
}  // namespace anthrob
