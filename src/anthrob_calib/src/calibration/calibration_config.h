#pragma once

#include <string>

#include "anthrob_core/config_node.h"
#include "optimiser/optimiser.h"
#include "problem/measured_run.h"
#include "problem/run_differences.h"
#include "problem/run_simulation.h"

namespace anthrob {
namespace calibration {

/// A calibration as its YAML file describes it; docs/calibration.md lists the keys.
struct CalibrationConfig {
  std::string file;
  std::string model_file;
  bool wants_trajectories = false;  ///< `recordings: trajectories`, else equilibria
  Weights weights;
  SimulationOptions simulation;
  OptimiserSettings optimiser;
  ConfigNode node;  ///< `parameters` and `shares` are read when the model is known

  /// @throws BadInput with one line
  static CalibrationConfig load(const std::string& file);
  /// @throws BadInput with file and line of `model` if it names no file
  void require_model() const;
  /// @throws BadInput if a run is not of the kind that `recordings` asks for
  void check(const std::vector<MeasuredRun>& runs, const std::string& folder) const;
};

}  // namespace calibration
}  // namespace anthrob
