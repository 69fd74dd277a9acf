#include "anthrob_sim/statics/equilibrium.h"

#include "anthrob_sim/statics/least_effort.h"

namespace anthrob {

Eigen::MatrixXd moment_arm_matrix(const Simulation& sim) {
  Eigen::MatrixXd A(sim.model().skeleton->velocity_count,
                    static_cast<Eigen::Index>(sim.muscle_count()));
  for (Eigen::Index m = 0; m < A.cols(); ++m) {
    const std::vector<double> arms = sim.moment_arms(static_cast<int>(m));
    A.col(m) = Eigen::Map<const Eigen::VectorXd>(arms.data(), A.rows());
  }
  return A;
}

Eigen::VectorXd gravity_load(const Simulation& sim) {
  const SkeletonModel& skeleton = *sim.model().skeleton;
  std::vector<BodyState> bodies = sim.bodies();
  for (BodyState& body : bodies) body.v_W.setZero(), body.w_W.setZero();
  KinematicTree tree(skeleton);
  std::vector<double> q = sim.configuration();
  tree.update(bodies, q);
  tree.update_dynamics(bodies, sim.model().gravity);
  Eigen::VectorXd load = tree.bias();
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
  const Eigen::VectorXd lowest = Eigen::VectorXd::Constant(count, options.lowest_tension);
  const Eigen::VectorXd highest = Eigen::VectorXd::Constant(count, options.highest_tension);
  const LeastEffort split =
      least_effort(moment_arm_matrix(sim), gravity_load(sim), lowest, highest);

  Equilibrium result;
  result.shortfall = split.shortfall;
  for (Eigen::Index m = 0; m < count; ++m) {
    const Muscle& muscle = sim.muscle(static_cast<int>(m));
    const MuscleModel& model = muscle.model();
    const double tension = split.tension[m];
    const double stretched = model.spring->rest_length() + model.spring->relaxed_expansion(tension);
    const double position = model.actuator->position_for(muscle.length() - stretched);
    const double input = model.actuator->holding_input(position, tension);
    result.tension.push_back(tension);
    result.position.push_back(position);
    if (!model.has_controller) {
      result.reference.push_back(input);
      continue;
    }
    const ecu::PositionGains& gains = model.controller.position;
    result.reference.push_back(position +
                               (input - gains.force_feedforward * tension) / gains.proportional);
  }
  return result;
}

}  // namespace anthrob
