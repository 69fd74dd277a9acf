#pragma once

#include <vector>

#include "anthrob_sim/simulation.h"
#include "experiment/experiment.h"

namespace anthrob {
namespace discovery {

/// Poses of driven joints at rest. In each of them, the effort that the simulated joint lacks to
/// stay there (Simulation::lacking_effort()) is compared with nothing:
///   difference = gravity + springs + stops + friction - effort - load  [Nm, N]
/// What is known of the direction from which a pose was approached decides the side of friction:
/// the joint creeps on in that direction. Where it is not known, friction may be any that can hold
/// the joint, and the difference is what is left beyond that.
///
/// One pose is a bin. There is no inertial effort, and nothing that depends on speed.
class PoseExperiment final : public Experiment {
 public:
  PoseExperiment(const RobotModel& model, const Dataset& recording, const PoseOptions& options);

  void compare(const std::shared_ptr<const RobotModel>& model, const Starts& starts,
               float* out) const override;

 private:
  /// A driven joint in all poses.
  struct Axis {
    int joint;
    std::vector<double> position, direction, effort, load;
  };

  void approach(Simulation& sim, std::size_t pose) const;
  double missing_effort(const Simulation& sim, const Axis& axis, double direction) const;

  PoseOptions options_;
  std::vector<Axis> axes_;
  std::size_t poses_ = 0;
};

}  // namespace discovery
}  // namespace anthrob
