#include "outside/outside.h"

namespace anthrob::virtual_robot {
namespace {

class Push final : public reference::JointLaw {
 public:
  Push(std::string place, double amplitude, double frequency)
      : place_(std::move(place)), amplitude_(amplitude), rate_(2.0 * M_PI * frequency) {}
  reference::Vector4 torque(const reference::JointState&) const override {
    const double now = amplitude_ * std::sin(rate_ * t_);
    return on_joint(place_, {0.6 * now, 0.0, 0.8 * now}, now);
  }
  void settle(double h, const reference::JointState&, const Eigen::Vector3d&) override { t_ += h; }

 private:
  std::string place_;
  double amplitude_, rate_;
  double t_ = 0.0;
};

}  // namespace

HiddenLaw periodic_push() {
  HiddenLaw law;
  law.id = "periodic_push";
  law.law = "torque that oscillates with time";
  law.sizes = {"amplitude"};
  law.most = 10.0;
  law.places = joint_places;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"amplitude", 0.2}, {"frequency", random->log_uniform(0.3, 3.0)}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->joint_laws.push_back(std::make_shared<Push>(h.place, h["amplitude"], h["frequency"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
