#include "anthrob_driver/emulation/tendon_plant.h"

#include <algorithm>

namespace anthrob {
namespace driver {

TendonPlant::TendonPlant(std::size_t muscles, std::size_t joints, std::size_t pads,
                         const Parameters& parameters)
    : p_(parameters), tendons_(muscles), joints_(joints, 0.0), pads_(pads, 0.0) {
  for (Tendon& tendon : tendons_) {
    tendon.slack = p_.slack;
    tendon.resistance = p_.resistance;
    tendon.back_emf = p_.constant * p_.ratio;
  }
}

TendonPlant::TendonPlant(const Hardware& hardware)
    : TendonPlant(hardware.muscles.size(), hardware.joints.size(), hardware.touch.size()) {
  for (std::size_t m = 0; m < tendons_.size(); ++m) {
    if (hardware.muscles[m].resistance <= 0.0) continue;
    tendons_[m].resistance = hardware.muscles[m].resistance;
    tendons_[m].back_emf = hardware.muscles[m].winch.back_emf;
  }
}

double TendonPlant::force(const Tendon& tendon) const {
  if (tendon.cut) return 0.0;
  return std::max(0.0, p_.stiffness * p_.radius * (tendon.position - tendon.slack));
}

Plant::Muscle TendonPlant::muscle(std::size_t muscle) const {
  const Tendon& tendon = tendons_[muscle];
  return {tendon.position, tendon.current, force(tendon)};
}

void TendonPlant::advance() {
  // The inductance's time constant is 0.07 ms: current is taken as settled.
  constexpr int kSteps = 10;
  constexpr double kStep = 0.001 / kSteps;
  const double inertia = p_.inertia * p_.ratio * p_.ratio;
  for (Tendon& t : tendons_) {
    const double kn = t.back_emf;
    for (int i = 0; i < kSteps; ++i) {
      t.current = (t.voltage - kn * t.velocity) / t.resistance;
      // Implicit in speed, so that back EMF and damping cannot make it unstable.
      const double drag = p_.damping * p_.ratio * p_.ratio + kn * kn / t.resistance;
      const double drive = kn * t.voltage / t.resistance - p_.radius * force(t);
      t.velocity = (inertia * t.velocity + kStep * drive) / (inertia + kStep * drag);
      if (t.jammed) t.velocity = 0.0;
      t.position += kStep * t.velocity;
    }
  }
}

}  // namespace driver
}  // namespace anthrob
