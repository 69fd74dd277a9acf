#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// A bundle that hardens as it is bent.
class HardeningBundle final : public reference::JointLaw {
 public:
  HardeningBundle(bool ball, double stiffness, double rest)
      : ball_(ball), stiffness_(stiffness), rest_(rest) {}

  reference::Vector4 torque(const reference::JointState& state) const override {
    reference::Vector4 result = reference::Vector4::Zero();
    if (!ball_) {
      result(3) = -pull(state.elbow - rest_);
      return result;
    }
    const Eigen::AngleAxisd turn(state.shoulder);
    result.head<3>() = -pull(turn.angle()) * turn.axis();
    return result;
  }

 private:
  static constexpr double kHard = 5.0;  // angle at which it is twice as stiff [rad]
  double pull(double angle) const {
    return stiffness_ * angle * (1.0 + angle * angle / (kHard * kHard));
  }
  bool ball_;
  double stiffness_, rest_;
};

}  // namespace

HiddenLaw cable_drag() {
  HiddenLaw law;
  law.id = "cable_drag";
  law.law = "stiffness (1 + (q / 5 rad)^2)";
  law.sizes = {"stiffness"};
  law.places = joint_places;
  law.draw = [](const auto&, const std::string& place, Random* random) -> Parameters {
    return {{"stiffness", is_shoulder(place) ? 0.5 : 0.1},
            {"rest", is_shoulder(place) ? 0.0 : random->uniform(0.0, 1.2)}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->joint_laws.push_back(
        std::make_shared<HardeningBundle>(is_shoulder(h.place), h["stiffness"], h["rest"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
