#include "touch/goal_posture.h"

#include <algorithm>
#include <cmath>

namespace anthrob {

AskedPosition position_for(const LinkJoint& joint, const Pose& X_PC, const JointPosition& near) {
  AskedPosition asked;
  const Pose moved = joint.X_PC_rest.inverse() * X_PC;
  const Quat turned(moved.R);
  double q = 0.0;
  if (joint.kind == JointKind::kBall) {
    asked.position.rotation = canonical(turned);
    return asked;
  }
  if (joint.kind == JointKind::kHinge) {
    const double angle = 2.0 * std::atan2(turned.vec().dot(joint.axis), turned.w());
    q = near.q + std::remainder(angle - near.q, 2.0 * M_PI);
  } else if (joint.kind == JointKind::kSlide) {
    q = moved.p.dot(joint.axis);
  }
  asked.position.q = std::clamp(q, joint.lo.value_or(q), joint.hi.value_or(q));
  asked.at_stop = asked.position.q != q;
  return asked;
}

void GoalPosture::ask(std::size_t link, const Pose& X_WC, const Posture& measured) {
  const Posture now = posture(measured);
  const SkeletonLink& child = skeleton_.links()[link];
  const Pose X_WP = skeleton_.pose(child.parent.value(), now);
  asked_[link] = position_for(child.joint, X_WP.inverse() * X_WC, now[link]);
}

Posture GoalPosture::posture(const Posture& measured) const {
  Posture posture = measured;
  for (const auto& [link, asked] : asked_) posture[link] = asked.position;
  return posture;
}

double GoalPosture::way(const Posture& measured) const {
  double longest = 0.0;
  for (const auto& [link, asked] : asked_) {
    longest = std::max({longest, std::abs(asked.position.q - measured[link].q),
                        angular_distance(asked.position.rotation, measured[link].rotation)});
  }
  return longest;
}

}  // namespace anthrob
