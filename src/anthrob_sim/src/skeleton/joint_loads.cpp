#include "skeleton/joint_loads.h"

namespace anthrob {

JointLoads::JointLoads(const SkeletonModel& model, const Vec3& gravity, double step, Of joints)
    : model_(model), gravity_(gravity), step_(step) {
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    if (joints == Of::kLoadFriction && model.joints[i].friction.load_radius == 0.0) continue;
    joints_.push_back(static_cast<int>(i));
    std::vector<int> bodies;
    for (int b = model.joints[i].child; b < static_cast<int>(model.bodies.size()); ++b) {
      int ancestor = b;
      while (ancestor > model.joints[i].child) ancestor = model.joints[ancestor - 1].parent;
      if (ancestor == model.joints[i].child) bodies.push_back(b);
    }
    beyond_.push_back(bodies);
  }
  carried_.assign(joints_.size(), Vec3::Zero());
}

void JointLoads::reset(double* loads) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    double mass = 0.0;
    for (const int b : beyond_[i]) mass += model_.bodies[b].mass;
    loads[joints_[i]] = mass * gravity_.norm();
  }
}

void JointLoads::before(const Skeleton& skeleton) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    carried_[i].setZero();
    for (const int b : beyond_[i]) {
      const double mass = model_.bodies[b].mass;
      carried_[i] -= mass * skeleton.bodies()[b].v_W / step_ + mass * gravity_ + skeleton.force(b);
    }
  }
}

void JointLoads::after(const Skeleton& skeleton) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    for (const int b : beyond_[i]) {
      carried_[i] += model_.bodies[b].mass * skeleton.bodies()[b].v_W / step_;
    }
  }
}

void JointLoads::write(const Skeleton& skeleton, double* loads) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const JointModel& joint = model_.joints[joints_[i]];
    if (joint.type != JointType::kPrismatic) {
      loads[joints_[i]] = carried_[i].norm();
      continue;
    }
    // A guide carries what is across it.
    const Mat3 R_WL =
        skeleton.bodies()[joint.child].X_WB.R * model_.bodies[joint.child].X_LB.R.transpose();
    const Vec3 axis_W = R_WL * joint.axis_C;
    loads[joints_[i]] = (carried_[i] - carried_[i].dot(axis_W) * axis_W).norm();
  }
}

}  // namespace anthrob
