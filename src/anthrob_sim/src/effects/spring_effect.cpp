#include "anthrob_sim/effects/spring_effect.h"

#include <algorithm>

#include "core/rising_root.h"

namespace anthrob {

ParallelForce::ParallelForce(std::shared_ptr<const SeriesElasticElement> inner,
                             std::size_t own_size, double step)
    : SpringWrapper(std::move(inner), state_size_of<Own>() + own_size), step_(step) {}

void ParallelForce::relax(double expansion, StateView state) const {
  inner().relax(expansion, inner_state(state));
  state.as<Own>() = {std::max(0.0, expansion), 0.0, 0.0};
  settle(state.as<Own>().stretch, subclass(state));
}

double ParallelForce::advance(double expansion, StateView state) const {
  Own& s = state.as<Own>();
  const double stretch = std::max(0.0, expansion);
  const double pull =
      inner().advance(expansion, inner_state(state)) + force(s.stretch, stretch, subclass(state));
  const double tension = stretch > 0.0 ? std::max(0.0, pull) : 0.0;
  s = {stretch, (stretch - s.stretch) / step_, tension - pull};
  return tension;
}

double ParallelForce::relaxed_tension(double expansion) const {
  const double stretch = std::max(0.0, expansion);
  if (stretch == 0.0) return 0.0;
  return std::max(0.0, inner().relaxed_tension(expansion) + settled_force(stretch));
}

double ParallelForce::relaxed_expansion(double tension) const {
  double high = 2.0 * inner().relaxed_expansion(tension) + 1e-3;
  while (relaxed_tension(high) < tension) high *= 2.0;
  return rising_root([&](double x) { return relaxed_tension(x) - tension; }, 0.0, high,
                     1e-12 * (1.0 + tension));
}

double ParallelForce::stored_energy(StateView state) const {
  return inner().stored_energy(inner_state(state)) +
         energy(state.as<Own>().stretch, subclass(state));
}

double ParallelForce::dissipation(double rate, StateView state) const {
  const Own& s = state.as<Own>();
  return inner().dissipation(rate, inner_state(state)) + heat(s.stretch, s.rate, subclass(state)) +
         s.lifted * s.rate;
}

double working_stretch(const SeriesElasticElement& element) {
  constexpr double kStrain = 0.3, kWithoutLength = 0.003;
  return element.rest_length() > 0.0 ? kStrain * element.rest_length() : kWithoutLength;
}

double working_stiffness(const SeriesElasticElement& element) {
  const double stretch = working_stretch(element);
  return element.relaxed_tension(stretch) / stretch;
}

}  // namespace anthrob
