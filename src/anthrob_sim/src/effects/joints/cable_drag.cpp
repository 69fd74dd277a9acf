#include <algorithm>
#include <cmath>

#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "cable_drag";
  i.name = "Stiffness of cables across a joint";
  i.description =
      "A bundle of cables across a joint pulls the joint back to where the cables are relaxed: a "
      "torque that depends on posture but not on the direction of gravity. On a ball joint it acts "
      "against the rotation from rest.";
  i.equation = "tau = -stiffness (q - rest)";
  i.source = "known; 0.05 Nm/rad measured on a real arm";
  i.where = "JOINT";
  i.seam = Seam::kJoints;
  i.stage = Stage::kComponents;
  i.channels = {"joint", "force"};
  i.parameters = {
      {"stiffness", "Nm/rad", "of the cables", 0.0, 0.05, {0.0, 1e6}},
      {"rest",
       "rad",
       "joint position with relaxed cables; for a ball joint always its rest",
       0.0,
       0.2,
       {-3.0, 3.0},
       EffectParameter::kShape},
  };
  return i;
}

class CableTorque final : public JointTorque {
 public:
  CableTorque(int index, const JointModel& joint, double stiffness, double rest)
      : index_(index),
        ball_(joint.type == JointType::kBall),
        position_(joint.position_offset),
        dof_(joint.velocity_offset),
        stiffness_(stiffness),
        rest_(rest) {}

  void add(const KinematicTree& tree, const std::vector<double>& q, double* tau) const override {
    if (!ball_) {
      tau[dof_] -= stiffness_ * (q[position_] - rest_);
      return;
    }
    const Vec3 torque_W = tree.joint(index_).R_WC * (-stiffness_ * rotation(q));
    for (int k = 0; k < 3; ++k) tau[dof_ + k] += torque_W[k];
  }
  double energy(const std::vector<double>& q) const override {
    const double stretch = ball_ ? rotation(q).norm() : q[position_] - rest_;
    return 0.5 * stiffness_ * stretch * stretch;
  }

 private:
  /// Rotation vector of a ball joint, the same in the child's axes at rest and now [rad].
  Vec3 rotation(const std::vector<double>& q) const {
    const double* p = &q[position_];
    const Vec3 axis(p[1], p[2], p[3]);
    const double sine = axis.norm();
    if (sine < 1e-12) return 2.0 * axis;
    return 2.0 * std::atan2(sine, p[0]) / sine * axis;
  }

  int index_;
  bool ball_;
  int position_, dof_;
  double stiffness_, rest_;
};

class CableDrag final : public JointEffect {
 public:
  CableDrag() : JointEffect(describe()) {}

  std::vector<EffectParameter> parameters_at(const RobotModel& robot,
                                             const std::string& place) const override {
    std::vector<EffectParameter> list = JointEffect::parameters_at(robot, place);
    const int joint = robot.skeleton->find_joint(place);
    if (joint >= 0 && robot.skeleton->joints[joint].type == JointType::kBall) {
      list.erase(std::remove_if(list.begin(), list.end(),
                                [](const EffectParameter& p) { return p.name == "rest"; }),
                 list.end());
    }
    return list;
  }

 protected:
  void change(const EffectSetting& setting, ModelDraft& draft, JointModel& joint) const override {
    const int index = static_cast<int>(&joint - draft.skeleton.joints.data());
    const double rest = joint.type == JointType::kBall ? 0.0 : setting["rest"];
    draft.robot.joint_torques.push_back(
        std::make_shared<CableTorque>(index, joint, setting["stiffness"], rest));
  }
};

const EffectRegistration kRegistration(std::make_unique<CableDrag>());

}  // namespace
}  // namespace anthrob
