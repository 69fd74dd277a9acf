#include "outside/outside.h"

namespace anthrob::virtual_robot {
namespace {

class Drag final : public reference::JointLaw {
 public:
  Drag(std::string place, double drag) : place_(std::move(place)), drag_(drag) {}
  reference::Vector4 torque(const reference::JointState& state) const override {
    const Eigen::Vector3d w = state.velocity.head<3>();
    const double v = state.velocity(3);
    return on_joint(place_, -drag_ * w.norm() * w, -drag_ * std::abs(v) * v);
  }

 private:
  std::string place_;
  double drag_;  // [Nm s^2]
};

}  // namespace

HiddenLaw quadratic_drag() {
  HiddenLaw law;
  law.id = "quadratic_drag";
  law.law = "torque against the square of the joint's speed";
  law.sizes = {"drag"};
  law.most = 20.0;
  law.places = joint_places;
  law.draw = [](const auto&, const std::string& place, Random*) -> Parameters {
    return {{"drag", is_shoulder(place) ? 0.3 : 0.03}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->joint_laws.push_back(std::make_shared<Drag>(h.place, h["drag"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
