#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// Friction of two levels, the sign made smooth by a hyperbolic tangent: it creeps where a true one
/// sticks.
class TwoLevels final : public reference::JointLaw {
 public:
  TwoLevels(double forward, double backward) : forward_(forward), backward_(backward) {}

  reference::Vector4 torque(const reference::JointState& state) const override {
    const double s = std::tanh(state.velocity(3) / kSmooth);
    return {0.0, 0.0, 0.0, -(s > 0.0 ? forward_ : backward_) * s};
  }
  reference::Vector4 damping(const reference::JointState& state) const override {
    const double s = std::tanh(state.velocity(3) / kSmooth);
    return {0.0, 0.0, 0.0, (s > 0.0 ? forward_ : backward_) * (1.0 - s * s) / kSmooth};
  }

 private:
  static constexpr double kSmooth = 5e-3;  // [rad/s]
  double forward_, backward_;
};

}  // namespace

HiddenLaw joint_coulomb_asymmetric() {
  HiddenLaw law;
  law.id = "joint_coulomb_asymmetric";
  law.law = "two levels with a smooth sign: creeps instead of sticking";
  law.sizes = {"forward", "backward"};
  law.places = elbow_only;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    const double share = random->uniform(0.2, 0.5);
    return random->uniform() < 0.5 ? Parameters{{"forward", 0.1}, {"backward", 0.1 * share}}
                                   : Parameters{{"forward", 0.1 * share}, {"backward", 0.1}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->joint_laws.push_back(std::make_shared<TwoLevels>(h["forward"], h["backward"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
