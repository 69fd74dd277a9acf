#pragma once

#include <string>
#include <vector>

#include "anthrob_calib/discovery/evaluator.h"
#include "anthrob_calib/discovery/noise_floor.h"

namespace anthrob {
namespace discovery {

/// A recording that tells two explanations apart: from a resting posture to targets and back, as
/// the recorder's protocol `trajectories` does it.
struct SeparatingRecording {
  struct Target {
    std::string name;
    std::vector<double> references;  ///< of the actuators, one a muscle [rad]
    double distance = 0.0;           ///< log score that tells the explanations apart [nat]
  };
  std::vector<double> rest;     ///< references where it starts
  std::vector<Target> targets;  ///< the one that tells most first; empty: none is known

  double distance() const;
};

/// Simulates both explanations on the way to postures of a recording: as they were, with more
/// co-contraction, and a tenth of the way, and keeps those in which they differ most. Empty if the
/// robot has no muscles, the recording has no references or other ones than of positions, or one of
/// the two cannot be simulated there.
/// @param scales noise floors by channel, of bins so long [s]   @throws Interrupted
SeparatingRecording plan_separation(const Evaluator& evaluator, const Variant& named,
                                    const Variant& rival, const Dataset& recording,
                                    const Scales& scales, double bin);

/// The commands of such a protocol, to every `stride`-th target beginning with `first`.
Dataset separating_commands(const RobotModel& model, const SeparatingRecording& plan,
                            std::size_t first = 0, std::size_t stride = 1);

}  // namespace discovery
}  // namespace anthrob
