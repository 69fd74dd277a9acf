#include <algorithm>

#include "anthrob_sim/effects/spring_effect.h"
#include "core/rising_root.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "tendon_elasticity";
  i.name = "Tendon elasticity";
  i.description =
      "The tendon gets longer in proportion to its force, in phase with it: the motor must wind "
      "further for the same force. The tendon is in series with the spring and carries the "
      "spring's force. Its length is that at position 0.";
  i.equation = "dL = compliance l_T0 f, compliance = 1 / (E A)";
  i.source = "known: 0.3-2 % at working load";
  i.where = "MUSCLE | all";
  i.seam = Seam::kTendon;
  i.channels = {"force", "joint", "position"};
  i.parameters = {{"compliance", "1/N", "strain per force", 0.0, 1e-4, {0.0, 0.01}}};
  return i;
}

/// The element solves how much of the expansion is its own: what is left is the tendon's.
class ElasticTendon final : public SpringWrapper {
 public:
  ElasticTendon(std::shared_ptr<const SeriesElasticElement> inner, double compliance, double step)
      : SpringWrapper(std::move(inner), state_size_of<Own>()),
        compliance_(compliance),
        step_(step) {}

  void relax(double expansion, StateView state) const override {
    const double own = settled(expansion);
    inner().relax(own, inner_state(state));
    state.as<Own>() = {own, 0.0, inner().relaxed_tension(own)};
  }
  double advance(double expansion, StateView state) const override {
    Own& s = state.as<Own>();
    const StateView spring = inner_state(state);
    double trial[kLargestState];
    const auto tension_at = [&](double x) {
      std::copy_n(spring.data(), inner().state_size(), trial);
      return inner().advance(x, StateView(trial));
    };
    const double own = share(expansion, tension_at);
    s.tension = inner().advance(own, spring);
    s.rate = (own - s.expansion) / step_;
    s.expansion = own;
    return s.tension;
  }
  double relaxed_tension(double expansion) const override {
    return inner().relaxed_tension(settled(expansion));
  }
  double relaxed_expansion(double tension) const override {
    return inner().relaxed_expansion(tension) + compliance_ * tension;
  }
  double stored_energy(StateView state) const override {
    const Own& s = state.as<Own>();
    return inner().stored_energy(inner_state(state)) + 0.5 * compliance_ * s.tension * s.tension;
  }
  double dissipation(double, StateView state) const override {
    return inner().dissipation(state.as<Own>().rate, inner_state(state));
  }

  static constexpr std::size_t kLargestState = 64;

 private:
  struct Own {
    double expansion, rate;  ///< of the element without the tendon [m, m/s]
    double tension;          ///< [N]
  };

  /// The part x of the expansion for which x + compliance f(x) is all of it.
  template <class Tension>
  double share(double expansion, const Tension& tension_at) const {
    const double most = compliance_ * tension_at(expansion);
    if (most == 0.0) return expansion;
    constexpr double kTolerance = 1e-14;  // [m]
    return rising_root([&](double x) { return x + compliance_ * tension_at(x) - expansion; },
                       expansion - most, expansion, kTolerance);
  }
  double settled(double expansion) const {
    return share(expansion, [&](double x) { return inner().relaxed_tension(x); });
  }

  double compliance_;  ///< of the whole tendon [m/N]
  double step_;
};

class TendonElasticity final : public SpringEffect {
 public:
  TendonElasticity() : SpringEffect(describe()) {}

 protected:
  std::shared_ptr<const SeriesElasticElement> wrap(const EffectSetting& setting,
                                                   const MuscleModel& muscle,
                                                   double step) const override {
    if (muscle.spring->state_size() > ElasticTendon::kLargestState) {
      setting.fail("place", "a spring with at most " +
                                std::to_string(ElasticTendon::kLargestState) + " state variables");
    }
    return std::make_shared<ElasticTendon>(
        muscle.spring, setting["compliance"] * rest_tendon_length(*muscle.actuator), step);
  }
};

const EffectRegistration kRegistration(std::make_unique<TendonElasticity>());

}  // namespace
}  // namespace anthrob
