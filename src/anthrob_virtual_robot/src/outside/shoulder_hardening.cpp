#include "outside/outside.h"

namespace anthrob::virtual_robot {
namespace {

/// A capsule that is loose up to an angle.
class Capsule final : public reference::JointLaw {
 public:
  Capsule(double stiffness, double loose) : stiffness_(stiffness), loose_(loose) {}
  reference::Vector4 torque(const reference::JointState& state) const override {
    const Eigen::AngleAxisd turn(state.shoulder);
    const double beyond = std::max(0.0, turn.angle() - loose_);
    return on_joint("shoulder", -stiffness_ * beyond * beyond * turn.axis(), 0.0);
  }

 private:
  double stiffness_;  // [Nm/rad^2]
  double loose_;      // [rad]
};

}  // namespace

HiddenLaw shoulder_hardening() {
  HiddenLaw law;
  law.id = "shoulder_hardening";
  law.law = "square of the shoulder's rotation beyond an angle";
  law.sizes = {"stiffness"};
  law.most = 10.0;
  law.places = shoulder_only;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"stiffness", 5.0}, {"loose", random->uniform(0.3, 0.45)}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->joint_laws.push_back(std::make_shared<Capsule>(h["stiffness"], h["loose"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
