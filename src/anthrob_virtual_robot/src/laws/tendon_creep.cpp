#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// Kelvin-Voigt elements with ratchets, one a decade: they do not come back. Under a force that
/// changes as in motion their sum follows the logarithm that hardens, under a constant one it is
/// 0.8 to 0.9 of it.
class SlowFibres final : public reference::MuscleLaw {
 public:
  SlowFibres(double rate, double onset) : rate_(rate), onset_(onset) {}
  double elongation() const override { return a_[0] + a_[1] + a_[2]; }
  void settle(double h, const reference::MuscleState&,
              const reference::MuscleSolution& solution) override {
    const double f = solution.tensions.front();
    double time = 4.3 * onset_;
    for (double& a : a_) {
      const double keep = std::exp(-h / time);
      a += (1.0 - keep) * std::max(0.0, kDecade * rate_ * f - a);
      time *= 10.0;
    }
  }

 private:
  static constexpr double kDecade = 2.302585 / 1.22;  // log 10; a changing force moves them more
  double rate_;                                       // of the whole tendon [m/N]
  double onset_;
  double a_[3] = {};
};

}  // namespace

HiddenLaw tendon_creep() {
  HiddenLaw law;
  law.id = "tendon_creep";
  law.law = "three Kelvin-Voigt elements with ratchets instead of a logarithm with hardening";
  law.sizes = {"rate"};
  law.places = muscle_places_and_all;
  law.slow = true;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"rate", 5e-5}, {"onset", random->log_uniform(0.7, 1.5)}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    add_to_muscles(h, draft, [&](const reference::MuscleParameters& muscle) {
      return std::make_shared<SlowFibres>(h["rate"] * muscle.rest_tendon_length, h["onset"]);
    });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
