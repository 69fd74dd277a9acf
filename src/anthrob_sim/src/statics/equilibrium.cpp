#include "anthrob_sim/statics/equilibrium.h"

#include <algorithm>

#include "anthrob_core/errors.h"
#include "anthrob_sim/effects/effect.h"
#include "anthrob_sim/spring/series_elastic_element.h"

namespace anthrob {

namespace {

/// Where the actuator would stand when the relaxed spring carries the tension.
double holding_position(const MuscleModel& muscle, double length, double tension) {
  const double stretched = muscle.spring->rest_length() + muscle.spring->relaxed_expansion(tension);
  return muscle.actuator->position_for(length - stretched);
}

/// The tension up to which the actuator can take its place. It is lower than asked for where the
/// actuator can pull its tendon in only so far, as a Hill muscle.
double reachable_tension(const MuscleModel& muscle, double length, double wanted) {
  const double highest = muscle.actuator->highest_position();
  if (holding_position(muscle, length, wanted) <= highest) return wanted;
  double low = 0.0, high = wanted;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (holding_position(muscle, length, middle) <= highest ? low : high) = middle;
  }
  return low;
}

/// Torque that a drive can hold without its gear's losses [Nm, N].
double stall_torque(const MuscleModel& drive) {
  return drive.actuator->input_high() / drive.actuator->holding_input(0.0, 1.0);
}

}  // namespace

double position_reference(const MuscleModel& muscle, double length, double tension) {
  const double position = holding_position(muscle, length, tension);
  const ecu::PositionGains& gains = muscle.controller.position;
  if (!(gains.proportional > 0.0)) {
    throw BadInput(
        "muscle " + muscle.name +
        ": position.proportional is 0; expected a gain with which a position can be held");
  }
  const double input = muscle.actuator->holding_input(position, tension);
  const double measured = muscle.has_force_sensor() ? tension : 0.0;
  return position + (input - gains.force_feedforward * measured) / gains.proportional;
}

Eigen::MatrixXd moment_arm_matrix(const Simulation& sim) {
  Eigen::MatrixXd A(sim.model().skeleton->velocity_count,
                    static_cast<Eigen::Index>(sim.muscle_count()));
  for (Eigen::Index m = 0; m < A.cols(); ++m) {
    const std::vector<double> arms = sim.moment_arms(static_cast<int>(m));
    A.col(m) = Eigen::Map<const Eigen::VectorXd>(arms.data(), A.rows());
  }
  return A;
}

Eigen::VectorXd holding_load(const Simulation& sim) {
  const SkeletonModel& skeleton = *sim.model().skeleton;
  std::vector<BodyState> bodies = sim.bodies();
  for (BodyState& body : bodies) body.v_W.setZero(), body.w_W.setZero();
  KinematicTree tree(skeleton);
  std::vector<double> q = sim.configuration();
  tree.update(bodies, q);
  tree.update_dynamics(bodies, sim.model().gravity);
  Eigen::VectorXd acting = -tree.bias();
  for (const auto& torque : sim.model().joint_torques) torque->add(tree, q, acting.data());
  Eigen::VectorXd load = -acting;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (skeleton.joints[j].type != JointType::kBall) continue;
    auto torque = load.segment<3>(skeleton.joints[j].velocity_offset);
    torque = (tree.joint(static_cast<int>(j)).R_WC.transpose() * torque).eval();
  }
  return load;
}

Equilibrium find_equilibrium(Simulation& sim, const std::vector<double>& q,
                             const EquilibriumOptions& options) {
  const Eigen::Index count = static_cast<Eigen::Index>(sim.muscle_count());
  sim.place(q, std::vector<double>(sim.muscle_count(), 0.0));
  Eigen::VectorXd lowest = Eigen::VectorXd::Constant(count, options.lowest_tension);
  Eigen::VectorXd highest = Eigen::VectorXd::Constant(count, options.highest_tension);
  for (Eigen::Index m = 0; m < count; ++m) {
    const Muscle& muscle = sim.muscle(static_cast<int>(m));
    if (muscle.model().is_drive()) {
      highest[m] = stall_torque(muscle.model());
      lowest[m] = -highest[m];
      continue;
    }
    if (muscle.model().actuator->takes_input()) {
      highest[m] = reachable_tension(muscle.model(), muscle.length(), options.highest_tension);
      lowest[m] = std::min(lowest[m], highest[m]);
      continue;
    }
    lowest[m] = highest[m] = muscle.model().spring->relaxed_tension(muscle.expansion());
  }
  const LeastEffort split =
      least_effort(moment_arm_matrix(sim), holding_load(sim), lowest, highest);

  Equilibrium result;
  result.shortfall = split.shortfall;
  for (Eigen::Index m = 0; m < count; ++m) {
    const MuscleModel& model = sim.model().muscles[m];
    const double length = sim.muscle(static_cast<int>(m)).length();
    const double tension = split.tension[m];
    // Where the actuator cannot even take up the tendon, it goes as far as it can.
    const double position =
        std::min(holding_position(model, length, tension), model.actuator->highest_position());
    result.tension.push_back(tension);
    result.position.push_back(position);
    result.reference.push_back(model.has_controller
                                   ? position_reference(model, length, tension)
                                   : model.actuator->holding_input(position, tension));
  }
  return result;
}

}  // namespace anthrob
