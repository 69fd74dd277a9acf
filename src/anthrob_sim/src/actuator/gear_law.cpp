#include <cmath>

#include "anthrob_sim/actuator/dc_motor.h"

namespace anthrob {

GearLaw::Load CurrentSignGear::load(double torque, double velocity, double current) const {
  const double backward = 0.5 * (std::tanh(-steepness_ * velocity * current - shift_) + 1.0);
  const double rho = efficiency_ + (1.0 / efficiency_ - efficiency_) * backward;
  return {torque / rho, 0.0};
}

GearLaw::Load LoadDirectionGear::load(double torque, double, double) const {
  const double up = torque / efficiency_, down = torque * efficiency_;
  return {0.5 * (up + down), 0.5 * std::abs(up - down)};
}

std::shared_ptr<const GearLaw> make_gear_law(const ConfigNode& node) {
  const double efficiency = node.number("efficiency", Bounds::fraction(), "1");
  const std::string law = node.text("law");
  if (law == "load_direction") return std::make_shared<LoadDirectionGear>(efficiency);
  if (law != "current_sign") node.at("law").fail_expected("one of: current_sign, load_direction");
  return std::make_shared<CurrentSignGear>(efficiency,
                                           node.number("steepness", Bounds::positive(), "1/W"),
                                           node.number("shift", Bounds::nonnegative(), "1"));
}

}  // namespace anthrob
