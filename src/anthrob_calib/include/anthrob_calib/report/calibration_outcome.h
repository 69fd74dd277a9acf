#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "anthrob_calib/calibration/identifiability.h"
#include "anthrob_calib/calibration/problem.h"
#include "anthrob_calib/optimiser/journal.h"
#include "anthrob_calib/optimiser/optimiser.h"

namespace anthrob {
namespace calibration {

/// Runs simulated in full length with the model as it was given and as it has become.
struct BeforeAfter {
  std::vector<MeasuredRun> runs;
  std::vector<RunDifferences> before, after;
};

/// The calibrated model driven in another way (section 8.3).
struct DriveErrors {
  std::string drive;
  double posture = 0.0;   ///< root mean square over runs and joints [rad]
  double force = 0.0;     ///< [N]
  double actuator = 0.0;  ///< largest difference of an actuator position [rad]
};

/// All there is to say about a calibration.
struct CalibrationOutcome {
  std::string config_file, model_file;
  OptimiserSettings optimiser;
  Weights weights;
  SimulationOptions simulation;
  std::shared_ptr<const RobotModel> model;  ///< for the names of joints and muscles
  std::vector<ModelParameter> parameters;
  Point best;
  std::map<std::string, double> overrides;  ///< of this calibration and those it started from
  std::map<std::string, double> given;      ///< what the model file has where they are
  double fitness_before = 0.0, fitness = 0.0;
  std::string reason;               ///< why the search ended
  std::vector<double> sensitivity;  ///< SearchResult has it
  int evaluations = 0;
  std::vector<Generation> history;
  BeforeAfter calibration, validation;  ///< no runs where they could not be simulated
  bool held_out = false;                ///< recordings to validate by were given
  Identifiability identifiability;
  std::vector<DriveErrors> drives;
  bool interrupted = false;  ///< before errors of the parameters were worked out
  std::string doubt;         ///< what could not be told, and why; or empty
};

/// Names of parameters that change nothing in what was compared, as far as the search's
/// derivatives tell.
std::vector<std::string> untold(const CalibrationOutcome& outcome);

/// Errors of runs as Tables C.12 and D.1 have them: means over runs of each run's mean.
struct MeanErrors {
  std::vector<double> joints;  ///< [rad]
  double force = 0.0;          ///< [N]
};
MeanErrors mean_errors(const std::vector<RunDifferences>& runs, const RobotModel& model);
/// Mean over instants of each joint's error, and over instants and muscles of force errors.
MeanErrors run_errors(const RunDifferences& run, const RobotModel& model);

}  // namespace calibration
}  // namespace anthrob
