#include "anthrob_reference/motor.h"

#include <cmath>

#include "check.h"

namespace anthrob::reference {

Motor::Motor(const MotorParameters& parameters)
    : resistance_(parameters.resistance + parameters.power_stage_resistance),
      inductance_(parameters.inductance),
      back_emf_(parameters.back_emf_constant * parameters.gear_ratio),
      torque_(parameters.torque_constant * parameters.gear_ratio),
      inertia_(parameters.gear_ratio * parameters.gear_ratio *
               (parameters.rotor_inertia + parameters.gear_inertia)),
      efficiency_(parameters.efficiency),
      steepness_(parameters.steepness),
      shift_(parameters.shift) {
  require_positive("motor resistance", resistance_);
  require_positive("motor inductance", inductance_);
  require_positive("motor inertia", inertia_);
  require_positive("gear efficiency", efficiency_);
  require(efficiency_ <= 1.0, "gear efficiency <= 1", efficiency_);
}

double Motor::current_rate(double voltage, double current, double speed) const {
  return (voltage - resistance_ * current - back_emf_ * speed) / inductance_;
}

double Motor::acceleration(double current, double speed, double load) const {
  return (torque_ * current - load / efficiency(current, speed)) / inertia_;
}

double Motor::efficiency(double current, double speed) const {
  // (tanh(-z) + 1) / 2 = 1 / (1 + exp(2 z))
  const double driven = 1.0 / (1.0 + std::exp(2.0 * (steepness_ * speed * current + shift_)));
  return efficiency_ + (1.0 / efficiency_ - efficiency_) * driven;
}

void Motor::solve_linear(double shift, double* current, double* speed) const {
  const double emf = back_emf_ / inductance_;
  const double drive = torque_ / inertia_;
  const double decay = shift + resistance_ / inductance_;
  const double determinant = decay * shift + emf * drive;
  const double solved_current = (shift * *current - emf * *speed) / determinant;
  *speed = (drive * *current + decay * *speed) / determinant;
  *current = solved_current;
}

}  // namespace anthrob::reference
