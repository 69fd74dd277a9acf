#pragma once

#include <memory>
#include <vector>

#include "anthrob_calib/calibration/measured_run.h"
#include "anthrob_calib/calibration/run_differences.h"
#include "anthrob_sim/simulation.h"

namespace anthrob {
namespace calibration {

/// What drives the actuators of a simulated run (section 8.3).
enum class Drive {
  kReferences,        ///< what was commanded
  kFinalPositions,    ///< position control to where the robot's actuators ended
  kSampledPositions,  ///< actuators follow the robot's
};

struct SimulationOptions {
  double settle = 2.0;  ///< longest simulated rest before the first command [s]
  double motion = 2.0;  ///< longest simulated part of a run [s]
  Drive drive = Drive::kReferences;
};

/// Runs in the order in which one leads to the other: the first of a chain starts where the robot
/// settles from its rest posture, each further one where the one before has ended.
struct Chain {
  std::vector<int> runs;
  bool from_home = true;  ///< starts at the references at which most runs start, or the first
};
std::vector<Chain> chains_of(const std::vector<MeasuredRun>& runs);

/// Puts the simulation into its rest posture, commanded to the references at which a run starts.
void stand_at_start(Simulation& sim, const MeasuredRun& run, const SimulationOptions& options);
/// For how long it settles there before the run's first command.
int steps_of_rest(const Simulation& sim, const MeasuredRun& run, const SimulationOptions& options);

/// Stands still as long as the robot did before the first command of a run that another one led to.
void wait_for_command(Simulation& sim, const MeasuredRun& run, const SimulationOptions& options);

/// Simulates one run from where the simulation is, and compares. If the simulated part is shorter
/// than the run, what it arrives at is compared with what the robot arrived at.
/// @throws NumericalFailure
RunDifferences follow(Simulation& sim, const MeasuredRun& run, const SimulationOptions& options);

/// All runs on one model; chains on as many threads as there are.
/// @throws NumericalFailure
std::vector<RunDifferences> simulate_runs(const std::shared_ptr<const RobotModel>& model,
                                          const std::vector<MeasuredRun>& runs,
                                          const SimulationOptions& options);

}  // namespace calibration
}  // namespace anthrob
