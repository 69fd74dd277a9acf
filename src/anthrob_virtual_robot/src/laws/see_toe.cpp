#include "laws.h"

namespace anthrob::virtual_robot {
namespace {

/// What bending takes away fades like an exponential.
class Bending final : public reference::MuscleLaw {
 public:
  Bending(double missing, double fade) : missing_(missing), fade_(fade) {}
  double spring_force(double stretch) const override {
    return -missing_ * stretch * std::exp(-stretch / fade_);
  }

 private:
  double missing_;  // stiffness at rest [N/m]
  double fade_;     // [m]
};

}  // namespace

HiddenLaw see_toe() {
  HiddenLaw law;
  law.id = "see_toe";
  law.law = "missing stiffness fades exponentially instead of ending at a strain";
  law.sizes = {"softness"};
  law.places = muscle_places_and_all;
  law.most = 3.0;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"softness", 0.3}, {"strain", random->uniform(0.45, 0.65)}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    add_to_muscles(h, draft, [&](const reference::MuscleParameters& muscle) {
      // x (1 - x)^2 and x exp(-x / 0.36) enclose nearly the same area up to 1.
      return std::make_shared<Bending>(h["softness"] * ring_stiffness(muscle.ring),
                                       0.36 * h["strain"] * muscle.ring.rest_length);
    });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
