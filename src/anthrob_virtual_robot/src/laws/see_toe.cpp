#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// What bending takes away fades ever faster and never quite ends. Near rest it is the parabola's,
/// and where rings work a parabola with a strain of its own fits it best at 0.9 to 1.05 of its
/// size.
class Bending final : public reference::MuscleLaw {
 public:
  Bending(double missing, double reach) : missing_(missing), reach_(reach) {}
  double spring_force(double stretch) const override {
    const double x = stretch / reach_;
    return -missing_ * stretch * std::exp(-x * (2.0 + x * (1.0 + 2.0 * x)));
  }

 private:
  double missing_;  // stiffness at rest [N/m]
  double reach_;    // [m]
};

}  // namespace

HiddenLaw see_toe() {
  HiddenLaw law;
  law.id = "see_toe";
  law.law = "missing stiffness fades exponentially, ever faster, instead of ending at a strain";
  law.sizes = {"softness"};
  law.places = muscle_places_and_all;
  law.most = 3.0;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"softness", 0.3}, {"strain", random->uniform(0.45, 0.65)}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    add_to_muscles(h, draft, [&](const reference::MuscleParameters& muscle) {
      return std::make_shared<Bending>(h["softness"] * ring_stiffness(muscle.ring),
                                       h["strain"] * muscle.ring.rest_length);
    });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
