#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// A braid that is softer while it is loose.
class Braid final : public reference::MuscleLaw {
 public:
  explicit Braid(double compliance) : compliance_(compliance) {}
  double elongation() const override { return elongation_; }
  void settle(double, const reference::MuscleState&,
              const reference::MuscleSolution& solution) override {
    const double f = solution.tensions.front();
    elongation_ = compliance_ * (f + kLoose * kBed * (1.0 - std::exp(-f / kBed)));
  }

 private:
  static constexpr double kLoose = 0.4;  // more compliance of the loose braid
  static constexpr double kBed = 4.0;    // force that beds it [N]
  double compliance_;                    // of the whole tendon [m/N]
  double elongation_ = 0.0;
};

}  // namespace

HiddenLaw tendon_elasticity() {
  HiddenLaw law;
  law.id = "tendon_elasticity";
  law.law = "softer below 4 N, by 40 %; under the tension of the first segment";
  law.sizes = {"compliance"};
  law.places = muscle_places_and_all;
  // Lengthening follows the force by a step: much more of it would chatter.
  law.most = 2.0;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters { return {{"compliance", 1e-4}}; };
  law.build = [](const Hidden& h, Draft* draft) {
    add_to_muscles(h, draft, [&](const reference::MuscleParameters& muscle) {
      return std::make_shared<Braid>(h["compliance"] * muscle.rest_tendon_length);
    });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
