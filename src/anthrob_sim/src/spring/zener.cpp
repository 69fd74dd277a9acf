#include "spring/zener.h"

namespace anthrob {

void Zener::relax(double expansion, StateView state) const {
  state.as<State>() = {ring_.strain(expansion), 0.0};
}

double Zener::advance(double expansion, StateView state) const {
  auto& s = state.as<State>();
  const double strain = ring_.strain(expansion);
  s.arm_stress = arm_.advance(s.arm_stress, strain - s.strain);
  s.strain = strain;
  return strain > 0.0 ? ring_.tension(modulus_ * strain + s.arm_stress) : 0.0;
}

double Zener::relaxed_tension(double expansion) const {
  return ring_.tension(modulus_ * ring_.strain(expansion));
}

double Zener::relaxed_expansion(double tension) const {
  return tension / (ring_.area * modulus_) * ring_.rest_length;
}

double Zener::stored_energy(StateView state) const {
  const auto& s = state.as<State>();
  return ring_.volume() *
         (0.5 * modulus_ * s.strain * s.strain + arm_.energy_density(s.arm_stress));
}

double Zener::dissipation(double rate, StateView state) const {
  const auto& s = state.as<State>();
  const double heat = ring_.volume() * arm_.heat_density(s.arm_stress);
  // Stress below zero is not passed on to the tendon; the balance of its work is heat.
  const double stress = modulus_ * s.strain + s.arm_stress;
  return s.strain > 0.0 && stress < 0.0 ? heat - ring_.area * stress * rate : heat;
}

std::shared_ptr<const SeriesElasticElement> Zener::load(const ConfigNode& node, int quantity,
                                                        double step) {
  return std::make_shared<Zener>(Ring::load(node, quantity),
                                 node.number("modulus", Bounds::positive(), "Pa"),
                                 MaxwellArm::load(node, "arm_modulus", step));
}

}  // namespace anthrob
