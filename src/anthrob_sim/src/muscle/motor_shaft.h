#pragma once

#include <vector>

#include "anthrob_sim/model/robot_model.h"
#include "friction/drive_shaft.h"

namespace anthrob {

/// The shaft between the motor of a drive and its joint, with twist e, motor ahead of the joint:
///   tau = k e' + d (w' - u'),  e' = e + h (s w' + t u'),  w' = w(tau) of the motor's own equations
/// where w' and u' are the speeds of motor and joint at the end of the step, both at the joint.
/// A shaft that does not give keeps e' = 0, and the rotor's inertia is felt at the joint.
///
/// A soft shaft takes the trapezoidal rule for the motor, whose equations are solved exactly, and
/// the symplectic one for the joint (s = 1/2, t = 0), which together lose no energy. Where the
/// vibration is faster than steps can follow, the shaft is solved implicitly (s = 1, t = -1), which
/// damps it and is stable at any stiffness. Play takes its width off the twist.
class MotorShaft final : public DriveShaft {
 public:
  /// How the motor is moved in a step.
  struct Motion {
    double input = 0.0;  ///< [V]
    bool imposed = false;
    double position = 0.0, velocity = 0.0;  ///< of a motor that is moved from outside
  };

  MotorShaft(const Actuator& motor, const Transmission& transmission, int dof, double step)
      : DriveShaft(dof),
        motor_(motor),
        transmission_(transmission),
        step_(step),
        before_(motor.state_size() + 1),
        after_(motor.state_size() + 1) {}

  /// Before each step.
  /// @param state of the motor        @param twist [rad, m]
  /// @param torque of the last step   @param inertia of the joint [kg m^2, kg]
  /// @param velocity of the joint [rad/s, m/s]
  void prepare(StateView state, const Motion& motion, double twist, double torque, double inertia,
               double velocity);
  double solve(double free, double response) override;

 private:
  /// By how much motor and joint come apart too fast at a torque, without play [rad/s, m/s]: falls
  /// with the torque.
  double parting(double torque, double free, double response);
  /// Speed of the motor at the end of the step, at the joint [rad/s, m/s].
  double speed_under(double torque);

  const Actuator& motor_;
  const Transmission& transmission_;
  double step_;
  std::vector<double> before_, after_;  ///< states of the motor
  Motion motion_;
  double twist_ = 0.0, inertia_ = 0.0;
  double implicit_ = 1.0;  ///< 0: soft, 1: stiff
  double last_ = 0.0;      ///< torque of the last step [Nm, N]
};

}  // namespace anthrob
