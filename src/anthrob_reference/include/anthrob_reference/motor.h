#pragma once

#include "anthrob_reference/parameters.h"

namespace anthrob::reference {

/// DC motor with gear (4.12); speed is that of the gear's output. With R = R_A + R_power_stage,
///   L di/dt = u - R i - K_E N w,
///   N^2 (J_M + J_G) dw/dt = N K_T i - load / rho,
///   rho = eta + (1/eta - eta) (tanh(-kappa w i - xi) + 1) / 2                          (4.13).
class Motor final {
 public:
  explicit Motor(const MotorParameters& parameters);

  /// di/dt [A/s]
  double current_rate(double voltage, double current, double speed) const;
  /// dw/dt [rad/s^2] under a load torque at the gear's output [Nm], positive against w > 0.
  double acceleration(double current, double speed, double load) const;
  /// dw/dt of a torque at the gear's output alone [rad/s^2].
  double unloaded_acceleration(double torque) const { return torque / inertia_; }
  /// rho of (4.13) [1]
  double efficiency(double current, double speed) const;
  /// (current, speed) <- (shift I - A)^-1 (current, speed), with A the exact Jacobian of the linear
  /// part: all but the load.
  void solve_linear(double shift, double* current, double* speed) const;

 private:
  double resistance_;
  double inductance_;
  double back_emf_;  // K_E N, at the gear's output [Vs/rad]
  double torque_;    // K_T N [Nm/A]
  double inertia_;   // N^2 (J_M + J_G) [kg m^2]
  double efficiency_;
  double steepness_;
  double shift_;
};

}  // namespace anthrob::reference
