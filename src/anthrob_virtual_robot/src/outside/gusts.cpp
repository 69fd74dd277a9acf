#include "outside/outside.h"

namespace anthrob::virtual_robot {
namespace {

/// Random torques that last for a while.
class Gusts final : public reference::JointLaw {
 public:
  Gusts(double strength, double seed, std::uint64_t run)
      : strength_(strength), random_(static_cast<std::uint64_t>(seed), run) {}
  reference::Vector4 torque(const reference::JointState&) const override {
    return on_joint("shoulder", strength_ * now_, 0.0);
  }
  void settle(double h, const reference::JointState&, const Eigen::Vector3d&) override {
    const double keep = std::exp(-h / kLasting);
    for (int k = 0; k < 3; ++k) {
      now_(k) = keep * now_(k) + std::sqrt(1.0 - keep * keep) * random_.normal();
    }
  }

 private:
  static constexpr double kLasting = 0.5;  // [s]
  double strength_;
  Random random_;
  Eigen::Vector3d now_ = Eigen::Vector3d::Zero();
};

}  // namespace

HiddenLaw gusts() {
  HiddenLaw law;
  law.id = "gusts";
  law.law = "random torques on the shoulder that last half a second";
  law.sizes = {"strength"};
  law.most = 10.0;
  law.places = shoulder_only;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"strength", 0.3}, {"seed", std::floor(random->uniform(0.0, 1e6))}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->joint_laws.push_back(std::make_shared<Gusts>(h["strength"], h["seed"], draft->run));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
