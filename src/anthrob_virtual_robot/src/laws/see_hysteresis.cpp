#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// Springs in series with dry sliders, in parallel (Iwan): rate-independent, and remembers the
/// reversals.
class Sliders final : public reference::MuscleLaw {
 public:
  Sliders(double force, double turn, double rest_length)
      : force_(force), turn_(turn), rest_length_(rest_length) {}
  double spring_force(double stretch) const override {
    if (!placed_) return 0.0;
    double sum = 0.0;
    for (std::size_t k = 0; k < kCount; ++k) sum += bent(k, stretch);
    return force_ * sum / kCount;
  }
  void settle(double, const reference::MuscleState&,
              const reference::MuscleSolution& solution) override {
    const double stretch = rest_length_ * solution.strain;
    for (std::size_t k = 0; k < kCount; ++k) {
      // A slider follows so that the spring never bends beyond its end.
      if (!placed_) slid_[k] = stretch;
      slid_[k] = stretch - reach(k) * bent(k, stretch);
    }
    placed_ = true;
  }

 private:
  static constexpr std::size_t kCount = 5;
  static constexpr double kEnds[kCount] = {0.25, 0.6, 1.0, 1.6, 2.6};
  double reach(std::size_t k) const { return kReach * turn_ * kEnds[k]; }
  double bent(std::size_t k, double stretch) const {
    return std::clamp((stretch - slid_[k]) / reach(k), -1.0, 1.0);
  }
  static constexpr double kReach = 0.850;  // 63 % of the way between the limits after one turn
  double force_, turn_, rest_length_;
  double slid_[kCount] = {};
  bool placed_ = false;
};

}  // namespace

HiddenLaw see_hysteresis() {
  HiddenLaw law;
  law.id = "see_hysteresis";
  law.law = "five dry sliders in parallel (Iwan) instead of Bouc and Wen";
  law.sizes = {"share"};
  law.places = muscle_places_and_all;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"share", 0.12}, {"turn", random->log_uniform(0.03, 0.08)}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    add_to_muscles(h, draft, [&](const reference::MuscleParameters& muscle) {
      const double l_0 = muscle.ring.rest_length;
      return std::make_shared<Sliders>(h["share"] * ring_stiffness(muscle.ring) * 0.3 * l_0,
                                       h["turn"] * l_0, l_0);
    });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
