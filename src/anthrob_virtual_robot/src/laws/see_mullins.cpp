#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// Ogden and Roxburgh (1999): the error function of the energy below the largest one so far.
class Virgin final : public reference::MuscleLaw {
 public:
  Virgin(double softening, double stiffness, double rest_length)
      : softening_(softening), stiffness_(stiffness), rest_length_(rest_length) {}
  double spring_force(double stretch) const override {
    const double largest = std::max(largest_, stretch);
    if (largest == 0.0) return 0.0;
    const double below = 1.0 - std::pow(stretch / largest, 2);
    return -softening_ * stiffness_ * stretch * std::erf(kSteep * below) / std::erf(kSteep);
  }
  void settle(double, const reference::MuscleState&,
              const reference::MuscleSolution& solution) override {
    largest_ = std::max(largest_, rest_length_ * solution.strain);
  }

 private:
  static constexpr double kSteep = 0.5;  // the parabola that fits best has 1.03 of its size
  double softening_, stiffness_, rest_length_;
  double largest_ = 0.0;  // stretch so far [m]
};

}  // namespace

HiddenLaw see_mullins() {
  HiddenLaw law;
  law.id = "see_mullins";
  law.law = "error function of the energy (Ogden, Roxburgh) instead of a parabola";
  law.sizes = {"softening"};
  law.places = muscle_places_and_all;
  law.slow = true;
  law.most = 3.0;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters { return {{"softening", 0.25}}; };
  law.build = [](const Hidden& h, Draft* draft) {
    add_to_muscles(h, draft, [&](const reference::MuscleParameters& muscle) {
      return std::make_shared<Virgin>(h["softening"], ring_stiffness(muscle.ring),
                                      muscle.ring.rest_length);
    });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
