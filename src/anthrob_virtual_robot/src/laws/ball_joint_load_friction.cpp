#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// Friction in proportion to the load of the last step, the sign made smooth.
class LoadedBall final : public reference::JointLaw {
 public:
  explicit LoadedBall(double lever) : lever_(lever) {}

  reference::Vector4 torque(const reference::JointState& state) const override {
    const Eigen::Vector3d w = state.velocity.head<3>();
    reference::Vector4 result = reference::Vector4::Zero();
    result.head<3>() = -lever_ * load_ * secant(w.norm()) * w;
    return result;
  }
  reference::Vector4 damping(const reference::JointState& state) const override {
    const double d = lever_ * load_ * secant(state.velocity.head<3>().norm());
    return {d, d, d, 0.0};
  }
  void settle(double, const reference::JointState&, const Eigen::Vector3d& load) override {
    load_ = load.norm();
  }

 private:
  static constexpr double kSmooth = 0.01;  // [rad/s]
  static double secant(double speed) {
    return speed > 1e-9 ? std::tanh(speed / kSmooth) / speed : 1.0 / kSmooth;
  }
  double lever_;  // mu times radius [m]
  double load_ = 0.0;
};

}  // namespace

HiddenLaw ball_joint_load_friction() {
  HiddenLaw law;
  law.id = "ball_joint_load_friction";
  law.law = "mu r |N| tanh(|w| / 0.01 rad/s): creeps instead of sticking";
  law.sizes = {"mu"};
  law.places = shoulder_only;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters {
    return {{"mu", 0.15}, {"radius", 0.015}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->joint_laws.push_back(std::make_shared<LoadedBall>(h["mu"] * h["radius"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
