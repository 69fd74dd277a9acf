#include <algorithm>

#include "anthrob_sim/inputs.h"
#include "simulation/checks.h"

namespace anthrob {

void ExternalWrenches::push(const Wrench& wrench) {
  expect_index(wrench.frame, skeleton_.frames.size(), "link");
  const std::string& link = skeleton_.frames[wrench.frame].name;
  for (int i = 0; i < 3; ++i) {
    expect_sensible(wrench.point[i], "link ", link, ": point of a wrench");
    expect_sensible(wrench.force[i], "link ", link, ": force");
    expect_sensible(wrench.torque[i], "link ", link, ": torque");
  }
  const auto same = std::find_if(acting_.begin(), acting_.end(), [&](const Wrench& other) {
    return other.frame == wrench.frame && other.point == wrench.point;
  });
  if (same == acting_.end() && wrench.steps_left > 0 && acting_.size() >= kMost) {
    throw BadInput("link " + link + ": wrench: expected at most " + std::to_string(kMost) +
                   " at once");
  }
  if (same != acting_.end()) acting_.erase(same);
  if (wrench.steps_left > 0) acting_.push_back(wrench);
}

ExternalWrenches::OnBody ExternalWrenches::on_body(const Wrench& wrench,
                                                   const std::vector<BodyState>& bodies) const {
  const FrameModel& frame = skeleton_.frames[wrench.frame];
  const Pose X_BF = skeleton_.bodies[frame.body].X_LB.inverse() * frame.X_LF;
  const Vec3 lever_W = bodies[frame.body].X_WB.R * (X_BF * wrench.point);
  return {frame.body, wrench.force, wrench.torque + lever_W.cross(wrench.force)};
}

void ExternalWrenches::add_generalised(const KinematicTree& tree,
                                       const std::vector<BodyState>& bodies,
                                       Eigen::VectorXd& tau) const {
  for (const Wrench& wrench : acting_) {
    const OnBody on = on_body(wrench, bodies);
    // Joint b - 1 moves body b; towards the world.
    for (int body = on.body; body > 0; body = skeleton_.joints[body - 1].parent) {
      const JointModel& joint = skeleton_.joints[body - 1];
      const KinematicTree::JointView& view = tree.joint(body - 1);
      const Vec3 lever = bodies[on.body].X_WB.p - view.center_W;
      const Vec3 torque = on.torque_W + lever.cross(on.force_W);
      switch (joint.type) {
        case JointType::kBall:
          tau.segment<3>(joint.velocity_offset) += torque;
          break;
        case JointType::kHinge:
          tau[joint.velocity_offset] += torque.dot(view.axis_W);
          break;
        case JointType::kPrismatic:
          tau[joint.velocity_offset] += on.force_W.dot(view.axis_W);
          break;
      }
    }
  }
}

void ExternalWrenches::count_step() {
  for (Wrench& wrench : acting_) --wrench.steps_left;
  acting_.erase(std::remove_if(acting_.begin(), acting_.end(),
                               [](const Wrench& wrench) { return wrench.steps_left == 0; }),
                acting_.end());
}

}  // namespace anthrob
