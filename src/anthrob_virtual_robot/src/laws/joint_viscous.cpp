#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// Grease that thins a little at speed.
class ThinningGrease final : public reference::JointLaw {
 public:
  ThinningGrease(bool ball, double damping)
      : first_(ball ? 0 : 3), count_(ball ? 3 : 1), damping_(damping) {}

  reference::Vector4 torque(const reference::JointState& state) const override {
    reference::Vector4 result = reference::Vector4::Zero();
    const Eigen::VectorXd w = state.velocity.segment(first_, count_);
    result.segment(first_, count_) = -damping_ / (1.0 + w.norm() / kThin) * w;
    return result;
  }
  reference::Vector4 damping(const reference::JointState&) const override {
    reference::Vector4 result = reference::Vector4::Zero();
    result.segment(first_, count_).setConstant(damping_);
    return result;
  }

 private:
  static constexpr double kThin = 30.0;  // where damping has halved [rad/s]
  Eigen::Index first_, count_;
  double damping_;
};

}  // namespace

HiddenLaw joint_viscous() {
  HiddenLaw law;
  law.id = "joint_viscous";
  law.law = "damping / (1 + |w| / 30 rad/s)";
  law.sizes = {"damping"};
  law.places = joint_places;
  law.draw = [](const auto&, const std::string& place, Random*) -> Parameters {
    return {{"damping", is_shoulder(place) ? 0.4 : 0.1}};
  };
  law.same_as = ModelNumber{
      [](const std::string& place) { return "joints." + place + ".friction.viscous"; },
      [](reference::ArmParameters* arm, const std::string& place) -> double& {
        auto& skeleton = arm->skeleton;
        return (is_shoulder(place) ? skeleton.shoulder_friction : skeleton.elbow_friction).viscous;
      }};
  law.build = [](const Hidden& h, Draft* draft) {
    draft->joint_laws.push_back(
        std::make_shared<ThinningGrease>(is_shoulder(h.place), h["damping"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
