#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "joint_offset_torque";
  i.name = "Constant joint torque";
  i.description =
      "A constant torque: a residual of gravity, an offset of the amplifier, a spring far from its "
      "rest. If dry friction is larger than this torque, it cannot be distinguished from "
      "direction-dependent friction (joint_coulomb_asymmetric), neither in motion nor at rest.";
  i.equation = "tau = torque";
  i.source = "Janot, Gautier, Brunot, EMPS benchmark 2019";
  i.where = "JOINT (hinges and slides)";
  i.seam = Seam::kJoints;
  i.stage = Stage::kComponents;
  i.channels = {"joint", "force"};
  i.parameters = {{"torque", "Nm", "forward positive", 0.0, 0.1, {-1e6, 1e6}}};
  return i;
}

class OffsetTorque final : public JointTorque {
 public:
  OffsetTorque(const JointModel& joint, double torque)
      : position_(joint.position_offset), dof_(joint.velocity_offset), torque_(torque) {}
  void add(const KinematicTree&, const std::vector<double>&, double* tau) const override {
    tau[dof_] += torque_;
  }
  double energy(const std::vector<double>& q) const override { return -torque_ * q[position_]; }

 private:
  int position_, dof_;
  double torque_;
};

class JointOffsetTorque final : public JointEffect {
 public:
  JointOffsetTorque() : JointEffect(describe()) {}

 protected:
  bool fits(const JointModel& joint) const override { return joint.type != JointType::kBall; }
  void change(const EffectSetting& setting, ModelDraft& draft, JointModel& joint) const override {
    draft.robot.joint_torques.push_back(std::make_shared<OffsetTorque>(joint, setting["torque"]));
  }
};

const EffectRegistration kRegistration(std::make_unique<JointOffsetTorque>());

}  // namespace
}  // namespace anthrob
