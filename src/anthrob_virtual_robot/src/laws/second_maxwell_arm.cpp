#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// A spring in series with a dashpot that yields more under more force (Eyring).
class EyringArm final : public reference::MuscleLaw {
 public:
  EyringArm(double stiffness, double time, double rest_length)
      : stiffness_(stiffness), time_(time), rest_length_(rest_length) {}
  double spring_force(double stretch) const override {
    return placed_ ? stiffness_ * (stretch - slid_) : 0.0;
  }
  void settle(double h, const reference::MuscleState&,
              const reference::MuscleSolution& solution) override {
    const double stretch = rest_length_ * solution.strain;
    if (!placed_) slid_ = stretch, placed_ = true;
    const double x = (stretch - slid_) / kYield;
    slid_ += h / time_ * kYield * std::sinh(x);
  }

 private:
  static constexpr double kYield = 0.006;  // stretch at which the dashpot is 18 % faster [m]
  double stiffness_, time_;
  double rest_length_;
  double slid_ = 0.0;  // of the dashpot [m]
  bool placed_ = false;
};

}  // namespace

HiddenLaw second_maxwell_arm() {
  HiddenLaw law;
  law.id = "second_maxwell_arm";
  law.law = "Eyring's dashpot (sinh) instead of a linear one";
  law.sizes = {"ratio"};
  law.places = muscle_places_and_all;
  law.slow = true;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"ratio", 0.15}, {"relaxation_time", random->log_uniform(6.0, 15.0)}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    add_to_muscles(h, draft, [&](const reference::MuscleParameters& muscle) {
      return std::make_shared<EyringArm>(h["ratio"] * ring_stiffness(muscle.ring),
                                         h["relaxation_time"], muscle.ring.rest_length);
    });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
