#pragma once

#include <string>

#include "anthrob_calib/calibration/measured_run.h"
#include "anthrob_calib/calibration/run_differences.h"
#include "anthrob_calib/calibration/run_simulation.h"
#include "anthrob_calib/optimiser/optimiser.h"
#include "anthrob_config/config_node.h"

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
