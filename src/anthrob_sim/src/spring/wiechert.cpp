#include "spring/wiechert.h"

namespace anthrob {

void Wiechert::relax(double expansion, StateView state) const {
  state[0] = ring_.strain(expansion);
  for (std::size_t i = 0; i < arms_.size(); ++i) state[1 + i] = 0.0;
}

double Wiechert::advance(double expansion, StateView state) const {
  const double strain = ring_.strain(expansion);
  double stress = modulus_ * strain;
  for (std::size_t i = 0; i < arms_.size(); ++i) {
    state[1 + i] = arms_[i].advance(state[1 + i], strain - state[0]);
    stress += state[1 + i];
  }
  state[0] = strain;
  return strain > 0.0 ? ring_.tension(stress) : 0.0;
}

double Wiechert::relaxed_tension(double expansion) const {
  return ring_.tension(modulus_ * ring_.strain(expansion));
}

double Wiechert::relaxed_expansion(double tension) const {
  return tension / (ring_.area * modulus_) * ring_.rest_length;
}

double Wiechert::stored_energy(StateView state) const {
  double density = 0.5 * modulus_ * state[0] * state[0];
  for (std::size_t i = 0; i < arms_.size(); ++i) density += arms_[i].energy_density(state[1 + i]);
  return ring_.volume() * density;
}

double Wiechert::dissipation(double rate, StateView state) const {
  double heat = 0.0, stress = modulus_ * state[0];
  for (std::size_t i = 0; i < arms_.size(); ++i) {
    heat += ring_.volume() * arms_[i].heat_density(state[1 + i]);
    stress += state[1 + i];
  }
  return state[0] > 0.0 && stress < 0.0 ? heat - ring_.area * stress * rate : heat;
}

std::shared_ptr<const SeriesElasticElement> Wiechert::load(const ConfigNode& node, int quantity,
                                                           double step) {
  const Ring ring = Ring::load(node, quantity);
  const double modulus = node.number("modulus", Bounds::positive(), "Pa");
  std::vector<MaxwellArm> arms;
  for (const ConfigNode& arm : node.at("arms").items()) {
    arms.push_back(MaxwellArm::load(arm, "modulus", step));
  }
  if (arms.empty()) node.at("arms").fail("expected at least one arm");
  return std::make_shared<Wiechert>(ring, modulus, std::move(arms));
}

}  // namespace anthrob
