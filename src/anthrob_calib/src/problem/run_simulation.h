#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "anthrob_sim/simulation.h"
#include "problem/measured_run.h"
#include "problem/run_differences.h"

namespace anthrob {
namespace calibration {

/// What drives the actuators of a simulated run (section 8.3).
enum class Drive {
  kReferences,        ///< the commanded references
  kFinalPositions,    ///< the final actuator positions of the robot, as references
  kSampledPositions,  ///< the actuators follow the sampled positions of the recording
};

struct SimulationOptions {
  double settle = 2.0;  ///< longest simulated rest before the first command [s]
  double motion = 2.0;  ///< longest simulated part of a run [s]
  Drive drive = Drive::kReferences;
};

/// Whether to end a simulation before its time, which then throws Interrupted. Asked about every
/// 1000 steps, from several threads at once; may be empty.
using Stop = std::function<bool()>;

/// Runs that follow one another: the first of a chain starts where the robot settles from its rest
/// posture, each further one where the run before it ended. Which runs follow one another does not
/// depend on the order of the list, unless several may follow the same one, or one may follow
/// several: then the first of these counts.
struct Chain {
  std::vector<int> runs;
  bool from_home = true;  ///< starts at the references of most runs; if tied, of the first run
};
std::vector<Chain> chains_of(const std::vector<MeasuredRun>& runs);

/// Puts the simulation into its rest posture, commanded to the references at which a run starts.
void stand_at_start(Simulation& sim, const MeasuredRun& run, const SimulationOptions& options);
/// Number of steps that it settles there before the run's first command.
int steps_of_rest(const Simulation& sim, const MeasuredRun& run, const SimulationOptions& options);

/// Waits for the first command of a run that follows another one in a chain, as long as the robot
/// did.
void wait_for_command(Simulation& sim, const MeasuredRun& run, const SimulationOptions& options,
                      const Stop& stop = {});

/// Simulates one run from the present state of the simulation, and compares it. If the simulated
/// part is shorter than the run, its end is compared with the end of the recorded run.
/// @throws NumericalFailure
RunDifferences follow(Simulation& sim, const MeasuredRun& run, const SimulationOptions& options,
                      const Stop& stop = {});

/// Simulates all runs with one model. Chains run in parallel on all threads. Compared is what the
/// model's sensors measure, with their delays and averages, without noise and counts.
/// @throws NumericalFailure
std::vector<RunDifferences> simulate_runs(const std::shared_ptr<const RobotModel>& robot,
                                          const std::vector<MeasuredRun>& runs,
                                          const SimulationOptions& options, const Stop& stop = {});

}  // namespace calibration
}  // namespace anthrob
