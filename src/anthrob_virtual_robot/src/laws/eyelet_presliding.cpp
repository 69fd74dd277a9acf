#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// Four springs in parallel that slip one after the other (Iwan), on the Stribeck curve of the
/// eyelet. In place of what was there.
class SlippingFibres final : public reference::MuscleLaw {
 public:
  SlippingFibres(const reference::StribeckParameters& sliding, double distance)
      : sliding_(sliding), reach_(kReach * distance) {}

  double friction(std::size_t eyelet, double v, double before) const override {
    if (reach_ == 0.0 || eyelet >= eyelets_.size()) return before;
    const double excess = sliding_.static_level - sliding_.kinetic_level;
    const double level =
        sliding_.kinetic_level + excess * std::exp(-std::abs(v) / sliding_.velocity);
    return level * eyelets_[eyelet].mean();
  }
  double friction_slope(std::size_t eyelet, double, double before) const override {
    // Fibres move between steps only.
    return reach_ == 0.0 || eyelet >= eyelets_.size() ? before : 0.0;
  }
  void settle(double h, const reference::MuscleState&,
              const reference::MuscleSolution& solution) override {
    if (reach_ == 0.0) return;
    eyelets_.resize(solution.sliding.size());
    for (std::size_t j = 0; j < eyelets_.size(); ++j) {
      for (std::size_t k = 0; k < kCount; ++k) {
        double& bent = eyelets_[j].bent[k];
        bent = std::clamp(bent + h * solution.sliding[j] / (reach_ * kEnds[k]), -1.0, 1.0);
      }
    }
  }

 private:
  static constexpr std::size_t kCount = 4;
  static constexpr double kEnds[kCount] = {0.3, 0.8, 1.5, 2.4};
  // So that 63 % of the way between the limits takes the distance, as with Dahl's law.
  static constexpr double kReach = 0.763;

  struct Fibres {
    double bent[kCount] = {};
    double mean() const { return (bent[0] + bent[1] + bent[2] + bent[3]) / kCount; }
  };

  reference::StribeckParameters sliding_;
  double reach_;
  std::vector<Fibres> eyelets_;
};

}  // namespace

HiddenLaw eyelet_presliding() {
  HiddenLaw law;
  law.id = "eyelet_presliding";
  law.law = "four slipping springs in parallel (Iwan) instead of Dahl's law";
  law.sizes = {"distance"};
  law.places = muscle_places_and_all;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters { return {{"distance", 5e-4}}; };
  law.build = [](const Hidden& h, Draft* draft) {
    add_to_muscles(h, draft, [&](const reference::MuscleParameters& muscle) {
      return std::make_shared<SlippingFibres>(muscle.eyelet_friction, h["distance"]);
    });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
