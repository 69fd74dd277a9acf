#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// LuGre (Canudas de Wit, Olsson, Astrom, Lischinsky 1995): bristles that bend; a vector of them
/// for a ball joint, so that friction opposes the rotation as a whole.
class Bristles final : public reference::JointLaw {
 public:
  Bristles(bool ball, double torque, double ratio, double stribeck)
      : first_(ball ? 0 : 3),
        count_(ball ? 3 : 1),
        torque_(torque),
        ratio_(ratio),
        stribeck_(stribeck) {}

  reference::Vector4 torque(const reference::JointState& state) const override {
    reference::Vector4 result = reference::Vector4::Zero();
    const Eigen::VectorXd w = state.velocity.segment(first_, count_);
    result.segment(first_, count_) = -torque_ * (bent_.head(count_) + kDamping * w);
    return result;
  }
  reference::Vector4 damping(const reference::JointState&) const override {
    reference::Vector4 result = reference::Vector4::Zero();
    result.segment(first_, count_).setConstant(torque_ * kDamping);
    return result;
  }
  void settle(double h, const reference::JointState& state, const Eigen::Vector3d&) override {
    const Eigen::VectorXd w = state.velocity.segment(first_, count_);
    const double speed = w.norm();
    if (speed == 0.0) return;
    // d bent / dt = (w - |w| bent / level) / kBend, exact for a constant speed.
    const double level = 1.0 + (ratio_ - 1.0) * std::exp(-std::pow(speed / stribeck_, 2));
    const double keep = std::exp(-h * speed / (level * kBend));
    bent_.head(count_) = keep * bent_.head(count_) + (1.0 - keep) * level * w / speed;
  }

 private:
  static constexpr double kBend = 2e-3;     // angle at which bristles slip [rad]
  static constexpr double kDamping = 0.02;  // of bristles [s/rad]
  Eigen::Index first_, count_;
  double torque_, ratio_, stribeck_;
  Eigen::Vector3d bent_ = Eigen::Vector3d::Zero();  // in units of the sliding torque
};

}  // namespace

HiddenLaw joint_coulomb() {
  HiddenLaw law;
  law.id = "joint_coulomb";
  law.law = "LuGre bristles instead of a Stribeck curve that sticks";
  law.sizes = {"torque"};
  law.places = joint_places;
  law.draw = [](const auto&, const std::string&, Random* random) -> Parameters {
    return {{"torque", 0.15},
            {"static_ratio", random->uniform(1.1, 1.5)},
            {"stribeck_velocity", random->log_uniform(0.03, 0.1)}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->joint_laws.push_back(std::make_shared<Bristles>(
        is_shoulder(h.place), h["torque"], h["static_ratio"], h["stribeck_velocity"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
