#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration/identifiability.h"
#include "optimiser/journal.h"
#include "optimiser/optimiser.h"
#include "problem/problem.h"

namespace anthrob {
namespace calibration {

/// Runs simulated in full length, with the given and with the calibrated model.
struct BeforeAfter {
  std::vector<MeasuredRun> runs;              ///< none if neither model could be simulated
  std::vector<RunDifferences> before, after;  ///< empty if that model could not be simulated
};

/// Errors of the calibrated model with other inputs of the actuators (section 8.3).
struct DriveErrors {
  std::string drive;
  double posture = 0.0;   ///< root mean square over runs and turning joints [rad]; NaN: none turns
  double force = 0.0;     ///< [N]
  double actuator = 0.0;  ///< largest difference of an actuator position [rad]
};

/// All results of a calibration.
struct CalibrationOutcome {
  std::string config_file, model_file;
  OptimiserSettings optimiser;
  Weights weights;
  SimulationOptions simulation;
  std::shared_ptr<const RobotModel> model;  ///< for the names of joints and muscles
  std::vector<ModelParameter> parameters;
  Point best;
  std::map<std::string, double> overrides;  ///< of this calibration and of those it started from
  std::map<std::string, double> given;      ///< values of the model file at the same paths
  double fitness_before = 0.0, fitness = 0.0;
  std::string reason;               ///< why the search ended
  std::vector<double> sensitivity;  ///< see SearchResult
  int evaluations = 0;
  std::vector<Generation> history;
  BeforeAfter calibration, validation;
  /// Of equilibria: how far the calibrated arm moves on from `simulation.motion`, when the search
  /// looked, to the end of the recordings, in the measure of the fitness.
  double moves_on = 0.0;
  bool held_out = false;  ///< whether held-out recordings were given
  Identifiability identifiability;
  std::vector<DriveErrors> drives;
  bool interrupted = false;  ///< before everything was computed
  std::string doubt;         ///< what could not be computed, and why; or empty
};

/// Names of the parameters that have no influence on the compared quantities, by the derivatives of
/// the search. Empty if the method has no derivatives.
std::vector<std::string> insensitive_parameters(const CalibrationOutcome& outcome);

/// Whether the search ended at an end of the range of a parameter, which may lie elsewhere then.
bool is_at_bound(const CalibrationOutcome& outcome, std::size_t parameter);

/// Says that the arm was not at rest when the search looked at equilibria. None if it was.
std::optional<std::string> too_early(const CalibrationOutcome& outcome);

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
