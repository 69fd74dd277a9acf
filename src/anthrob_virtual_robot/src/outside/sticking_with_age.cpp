#include "outside/outside.h"

namespace anthrob::virtual_robot {
namespace {

/// Friction whose level grows with the logarithm of the time at rest and is gone once it moves.
class Ageing final : public reference::JointLaw {
 public:
  explicit Ageing(double torque) : torque_(torque) {}
  reference::Vector4 torque(const reference::JointState& state) const override {
    return {0.0, 0.0, 0.0, -level() * std::tanh(state.velocity(3) / kSmooth)};
  }
  reference::Vector4 damping(const reference::JointState& state) const override {
    const double t = std::tanh(state.velocity(3) / kSmooth);
    return {0.0, 0.0, 0.0, level() * (1.0 - t * t) / kSmooth};
  }
  void settle(double h, const reference::JointState& state, const Eigen::Vector3d&) override {
    age_ += h;
    age_ *= std::exp(-h * std::abs(state.velocity(3)) / kSlip);
  }

 private:
  static constexpr double kSmooth = 5e-3;  // [rad/s]
  static constexpr double kSlip = 0.03;    // motion that renews the contact [rad]
  double level() const { return torque_ * std::log1p(age_ / 0.02); }
  double torque_;
  double age_ = 0.0;  // [s]
};

}  // namespace

HiddenLaw sticking_with_age() {
  HiddenLaw law;
  law.id = "sticking_with_age";
  law.law = "friction that grows with the time at rest";
  law.sizes = {"torque"};
  law.most = 10.0;
  law.places = elbow_only;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters { return {{"torque", 0.05}}; };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->joint_laws.push_back(std::make_shared<Ageing>(h["torque"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
