#pragma once

#include <string>
#include <vector>

#include "experiment/evaluator.h"
#include "experiment/noise_floor.h"
#include "options/options.h"

namespace anthrob {
namespace discovery {

/// A recording that tells two explanations apart: from a rest posture to each target and back, as
/// the recorder's protocol `trajectories` does it.
struct SeparatingRecording {
  struct Target {
    std::string name;
    std::vector<double> references;  ///< of the actuators, one a muscle [rad]
    double distance = 0.0;           ///< expected difference of the explanations in log score [nat]
  };
  std::vector<double> rest;     ///< references where it starts
  std::vector<Target> targets;  ///< largest distance first; empty: no such recording is known

  double distance() const;
};

/// Simulates both explanations on the way to postures of a recording: to the postures themselves,
/// to the same with all spindles wound in further, and a little of the way. Keeps the targets in
/// which the explanations differ most. Empty if the robot has no muscles, if the
/// recording has no references or not all of them are positions, or if one of the two cannot be
/// simulated.
/// @param scales noise floors by channel, for bins of length `bin` [s]   @throws Interrupted
SeparatingRecording plan_separation(const Evaluator& evaluator, const Variant& named,
                                    const Variant& rival, const Dataset& recording,
                                    const Scales& scales, double bin, const Options& options);

/// The commands of such a protocol, to every `stride`-th target beginning with `first`.
Dataset separating_commands(const RobotModel& model, const SeparatingRecording& plan,
                            const SeparationOptions& options, std::size_t first = 0,
                            std::size_t stride = 1);

}  // namespace discovery
}  // namespace anthrob
