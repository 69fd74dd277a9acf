#include "friction/sticking.h"

#include <algorithm>
#include <cmath>

namespace anthrob {

namespace {
struct Level {
  double mu, slope;
};

Level stribeck(double v, double kinetic, double fixed, double velocity) {
  const double excess = (fixed - kinetic) * std::exp(-std::abs(v) / velocity);
  return {kinetic + excess, -excess / velocity};
}
}  // namespace

FrictionLaw::Value Sticking::evaluate(double v, StateView state) const {
  const double elastic = static_ * (state[0] + v * step_) / presliding_;
  const Level level = stribeck(v, kinetic_, static_, velocity_);
  if (std::abs(elastic) <= level.mu) return {elastic, static_ * step_ / presliding_};
  return {std::copysign(level.mu, elastic), elastic * v >= 0.0 ? level.slope : -level.slope};
}

void Sticking::commit(double v, StateView state) const {
  const double level = stribeck(v, kinetic_, static_, velocity_).mu;
  // The bristle stretches no further than the level of friction bends it.
  const double reach = static_ > 0.0 ? presliding_ * level / static_ : 0.0;
  state[0] = std::clamp(state[0] + v * step_, -reach, reach);
}

std::shared_ptr<const FrictionLaw> Sticking::load(const ConfigNode& node, double step) {
  const double fixed = node.number("static", Bounds::nonnegative(), "1"),
               kinetic = node.number("kinetic", Bounds::nonnegative(), "1");
  // What does not stick has no bristle that could pull.
  if (!(fixed > 0.0) && kinetic > 0.0) {
    node.at("static").fail_expected("a number > 0, because 'kinetic' is > 0");
  }
  return std::make_shared<Sticking>(fixed, kinetic,
                                    node.number("stribeck_velocity", Bounds::positive(), "m/s"),
                                    node.number("presliding", Bounds::positive(), "m"), step);
}

}  // namespace anthrob
