#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// A secant modulus that is quadratic in the strain, or whose inverse is where it falls.
class SecantModulus final : public reference::MuscleLaw {
 public:
  SecantModulus(double rate, double stiffness, double length)
      : half_(0.5 * rate), stiffness_(stiffness), length_(length) {}
  double spring_force(double stretch) const override {
    const double x = std::abs(half_) * stretch / length_, more = x + 0.5 * x * x;
    return stiffness_ * stretch * (half_ > 0.0 ? more : -more / (1.0 + more));
  }

 private:
  double half_;       // change of the secant modulus over small strains [1]
  double stiffness_;  // [N/m]
  double length_;     // [m]
};

}  // namespace

HiddenLaw see_stiffening() {
  HiddenLaw law;
  law.id = "see_stiffening";
  law.law = "secant modulus quadratic in the strain; where it falls, its inverse";
  law.sizes = {"stiffening"};
  law.places = muscle_places_and_all;
  law.most = 6.0;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"stiffening", random->uniform(-1.0, 1.0) < 0.0 ? -0.4 : 0.4}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    add_to_muscles(h, draft, [&](const reference::MuscleParameters& muscle) {
      return std::make_shared<SecantModulus>(h["stiffening"], ring_stiffness(muscle.ring),
                                             muscle.ring.rest_length);
    });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
