#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

class ConstantTorque final : public reference::JointLaw {
 public:
  explicit ConstantTorque(double torque) : torque_(torque) {}
  reference::Vector4 torque(const reference::JointState&) const override {
    return {0.0, 0.0, 0.0, torque_};
  }

 private:
  double torque_;
};

}  // namespace

HiddenLaw joint_offset_torque() {
  HiddenLaw law;
  law.id = "joint_offset_torque";
  law.law = "as in the catalogue";
  law.sizes = {"torque"};
  law.places = elbow_only;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"torque", 0.1 * random->sign()}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->joint_laws.push_back(std::make_shared<ConstantTorque>(h["torque"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
