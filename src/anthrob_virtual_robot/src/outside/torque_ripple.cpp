#include "outside/outside.h"

namespace anthrob::virtual_robot {
namespace {

class Ripple final : public reference::JointLaw {
 public:
  Ripple(double amplitude, double periods) : amplitude_(amplitude), periods_(periods) {}
  reference::Vector4 torque(const reference::JointState& state) const override {
    return {0.0, 0.0, 0.0, amplitude_ * std::sin(periods_ * state.elbow)};
  }

 private:
  double amplitude_, periods_;
};

}  // namespace

HiddenLaw torque_ripple() {
  HiddenLaw law;
  law.id = "torque_ripple";
  law.law = "torque of the elbow that repeats with its angle";
  law.sizes = {"amplitude"};
  law.most = 10.0;
  law.places = elbow_only;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"amplitude", 0.1}, {"periods", random->uniform(5.0, 9.0)}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->joint_laws.push_back(std::make_shared<Ripple>(h["amplitude"], h["periods"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
