#include "anthrob_sim/actuator/dc_motor.h"

#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

namespace anthrob {

DcMotor::DcMotor(const Parameters& parameters, std::shared_ptr<const GearLaw> gear, double step)
    : p_(parameters), gear_(std::move(gear)), step_(step) {
  // (4.12) with the load torque already divided by rho, position appended, inputs held: zero-order
  // hold.
  const double J = p_.inertia * p_.ratio * p_.ratio;
  Eigen::Matrix<double, 5, 5> A = Eigen::Matrix<double, 5, 5>::Zero();
  enum { kCurrent, kVelocity, kPosition, kVoltage, kTorque };
  A(kCurrent, kCurrent) = -p_.resistance / p_.inductance;
  A(kCurrent, kVelocity) = -p_.back_emf_constant * p_.ratio / p_.inductance;
  A(kCurrent, kVoltage) = 1.0 / p_.inductance;
  A(kVelocity, kCurrent) = p_.torque_constant * p_.ratio / J;
  A(kVelocity, kTorque) = -1.0 / J;
  A(kPosition, kVelocity) = 1.0;
  const Eigen::Matrix<double, 5, 5> E = (A * step).exp();
  map_.col(0) = E.col(kCurrent).head<3>();
  map_.col(1) = E.col(kVelocity).head<3>();
  map_.col(2) = E.col(kVoltage).head<3>();
  map_.col(3) = E.col(kTorque).head<3>();
  stuck_keep_ = std::exp(-p_.resistance / p_.inductance * step);
  stuck_gain_ = (1.0 - stuck_keep_) / p_.resistance;
}

void DcMotor::place(double position, StateView state) const {
  state.as<State>() = {0.0, 0.0, position};
}

void DcMotor::impose(double position, double velocity, double, StateView state) const {
  auto& s = state.as<State>();
  s.current = 0.0;  // what moves it is not its winding
  s.velocity = velocity;
  s.position = position;
}

void DcMotor::advance_with(double input, double load, double torque, StateView state) const {
  auto& s = state.as<State>();
  GearLaw::Load at_gear = gear_->load(load * p_.spindle_radius, s.velocity, s.current);
  at_gear.torque -= torque;
  at_gear.friction += p_.ratio * p_.friction_torque;
  if (at_gear.friction > 0.0) {
    advance_with_friction(input, at_gear, s);
  } else {
    apply(input, at_gear.torque, s);
  }
}

void DcMotor::apply(double input, double torque, State& s) const {
  const Eigen::Vector3d next = map_ * Eigen::Vector4d(s.current, s.velocity, input, torque);
  // Speeds that decay for ever would end as denormal numbers, which are slow.
  constexpr double kNothing = 1e-200;
  s.current = std::abs(next[0]) < kNothing ? 0.0 : next[0];
  s.velocity = std::abs(next[1]) < kNothing ? 0.0 : next[1];
  s.position += next[2];
}

void DcMotor::advance_with_friction(double input, const GearLaw::Load& load, State& s) const {
  if (s.velocity == 0.0) {
    const double held_current = stuck_keep_ * s.current + stuck_gain_ * input;
    const double drive = p_.ratio * p_.torque_constant * held_current - load.torque;
    if (std::abs(drive) <= load.friction) {
      s.current = held_current;
      return;
    }
    apply(input, load.torque + std::copysign(load.friction, drive), s);
    return;
  }
  const double before = s.velocity;
  const double position = s.position, current = s.current;
  apply(input, load.torque + std::copysign(load.friction, before), s);
  if (before * s.velocity < 0.0) {
    // Friction brings the shaft to rest; whether it then moves on is for the next step to say.
    s.position = position + 0.5 * step_ * before * before / (before - s.velocity);
    s.velocity = 0.0;
    // Without what turning back would have induced.
    s.current = stuck_keep_ * current + stuck_gain_ * input;
  }
}

Actuator::Readout DcMotor::read(StateView state) const {
  const auto& s = state.as<State>();
  return {s.position, s.velocity, s.current};
}

double DcMotor::tendon_length(StateView state) const {
  return p_.rest_tendon_length - p_.spindle_radius * state.as<State>().position;
}

double DcMotor::winding_speed(StateView state) const {
  return p_.spindle_radius * state.as<State>().velocity;
}

double DcMotor::position_for(double tendon_length) const {
  return (p_.rest_tendon_length - tendon_length) / p_.spindle_radius;
}

double DcMotor::holding_input(double, double load) const {
  const double torque = gear_->load(load * p_.spindle_radius, 0.0, 0.0).torque;
  return p_.resistance * torque / (p_.ratio * p_.torque_constant);
}

std::shared_ptr<const Actuator> DcMotor::load(const ConfigNode& kind, const ConfigNode& muscle,
                                              double step) {
  const double radius = muscle.number("spindle_radius", {0.0, 0.5, true, false}, "m");
  return build(kind, radius, read_rest_tendon_length(muscle), step);
}

std::shared_ptr<const Actuator> DcMotor::build(const ConfigNode& kind, double spindle_radius,
                                               double rest_tendon_length, double step) {
  const ConfigNode motor = kind.at("motor"), gear = kind.at("gear");
  Parameters p;
  p.winding_resistance = motor.number("resistance", Bounds::positive(), "ohm");
  p.resistance = p.winding_resistance +
                 kind.at("power_stage").number("resistance", Bounds::nonnegative(), "ohm");
  p.inductance = motor.number("inductance", Bounds::positive(), "H");
  p.torque_constant = motor.number("torque_constant", Bounds::positive(), "Nm/A");
  p.back_emf_constant = motor.number("back_emf_constant", Bounds::positive(), "Vs/rad");
  p.inertia = motor.number("rotor_inertia", Bounds::positive(), "kg m^2") +
              gear.number("inertia", Bounds::nonnegative(), "kg m^2");
  p.ratio = gear.number("ratio", Bounds::positive(), "1");
  p.friction_torque = gear.number("friction_torque", Bounds::nonnegative(), "Nm");
  p.spindle_radius = spindle_radius;
  p.rest_tendon_length = rest_tendon_length;
  p.voltage_limit = kind.number("nominal_voltage", Bounds::positive(), "V");
  return std::make_shared<DcMotor>(p, make_gear_law(gear), step);
}

}  // namespace anthrob
