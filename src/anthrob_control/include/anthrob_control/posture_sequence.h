#pragma once

#include <string>
#include <vector>

#include "anthrob_sim/simulation.h"
#include "anthrob_sim/statics/equilibrium.h"

namespace anthrob {

/// Of what muscles deliver to the joints: "Nm", "N" if all slide, "Nm or N" if some do.
std::string torque_unit(const SkeletonModel& skeleton);

/// @throws BadInput naming posture and model if more than 0.02 Nm (N) are missing to hold the
/// posture
void refuse_if_not_holdable(const std::string& name, const RobotModel& model,
                            const Equilibrium& equilibrium);
/// Refuses references beyond the muscles' limits, as simulator and driver would.
/// @throws BadInput naming posture, muscle and limit
void refuse_beyond_limits(const std::string& posture, const RobotModel& model,
                          const std::vector<double>& reference);
/// @throws BadInput for a robot without any muscle that takes POSITION: nothing would move
void refuse_without_controllers(const RobotModel& model);

/// A posture to visit, and how long to stay.
struct PostureStep {
  std::string name;
  std::vector<double> q;  ///< joint positions, as in a configuration
  double hold = 3.0;      ///< time from the command to the next step [s]
  /// Actuator references, one per muscle [rad]; empty if they must be derived from the posture.
  std::vector<double> reference;
};

/// A list of postures in a YAML file:
///   lowest_tension: 1.0
///   postures:
///     - {name: raised, hold: 4.0, joints: {shoulder: [w, x, y, z], elbow: 1.0}}
///     - {name: E1, references: {lateral_deltoid: 3.1, ...}}   # as recorded, all muscles
/// Joints that are not named are at rest.
struct PostureSequence {
  EquilibriumOptions options;
  std::vector<PostureStep> steps;

  /// @throws BadInput with one line
  static PostureSequence load(const std::string& file, const RobotModel& model);

  /// Actuator references for every step, given or derived from the model.
  /// @throws BadInput if the muscles cannot hold a posture
  std::vector<std::vector<double>> references(const std::shared_ptr<const RobotModel>& model) const;
};

}  // namespace anthrob
