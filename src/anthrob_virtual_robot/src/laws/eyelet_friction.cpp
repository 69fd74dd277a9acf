#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// Coulomb friction, the sign made smooth by a hyperbolic tangent; no excess at rest.
class Rubbing final : public reference::MuscleLaw {
 public:
  explicit Rubbing(double mu) : mu_(mu) {}
  double friction(std::size_t, double v, double before) const override {
    return before + mu_ * std::tanh(v / kSmooth);
  }
  double friction_slope(std::size_t, double v, double before) const override {
    const double t = std::tanh(v / kSmooth);
    return before + mu_ * (1.0 - t * t) / kSmooth;
  }

 private:
  static constexpr double kSmooth = 3e-4;  // [m/s]
  double mu_;
};

}  // namespace

HiddenLaw eyelet_friction() {
  HiddenLaw law;
  law.id = "eyelet_friction";
  law.law = "mu tanh(v / 0.3 mm/s), no excess at rest, instead of the model's Stribeck law";
  law.sizes = {"mu"};
  law.places = muscle_places_and_all;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters { return {{"mu", 0.1}}; };
  law.build = [](const Hidden& h, Draft* draft) {
    add_to_muscles(h, draft, [&](const auto&) { return std::make_shared<Rubbing>(h["mu"]); });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
