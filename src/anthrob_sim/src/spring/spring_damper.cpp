#include "spring/spring_damper.h"

#include <algorithm>

namespace anthrob {

double SpringDamper::advance(double expansion, StateView state) const {
  const double rate = (expansion - state[0]) / step_;
  state[0] = expansion;
  if (expansion <= 0.0) return 0.0;
  return std::max(0.0, stiffness_ * expansion + damping_ * rate);
}

double SpringDamper::relaxed_tension(double expansion) const {
  return std::max(0.0, stiffness_ * expansion);
}

double SpringDamper::stored_energy(StateView state) const {
  const double stretch = std::max(0.0, state[0]);
  return 0.5 * stiffness_ * stretch * stretch;
}

double SpringDamper::dissipation(double rate, StateView state) const {
  if (state[0] <= 0.0) return 0.0;
  // Where the damper would push, the element goes slack: it gives back less than the spring holds.
  const double tension = std::max(0.0, stiffness_ * state[0] + damping_ * rate);
  return (tension - stiffness_ * state[0]) * rate;
}

std::shared_ptr<const SeriesElasticElement> SpringDamper::load(const ConfigNode& node, int quantity,
                                                               double step) {
  return std::make_shared<SpringDamper>(
      node.number("rest_length", Bounds::between(0.0, 1.0), "m"),
      quantity * node.number("stiffness", Bounds::positive(), "N/m"),
      quantity * node.number("damping", Bounds::nonnegative(), "Ns/m"), step);
}

}  // namespace anthrob
