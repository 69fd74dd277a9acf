#pragma once

namespace anthrob {

/// The end of a drive at its joint, as the solver of the joints' motion sees it: its torque depends
/// on the velocity of the joint at the end of the step, because the joint turns the motor.
class DriveShaft {
 public:
  /// @param dof generalised velocity of the joint
  explicit DriveShaft(int dof) : dof_(dof) {}
  virtual ~DriveShaft() = default;

  int dof() const { return dof_; }
  /// On the joint, in this step [Nm, N].
  double torque() const { return torque_; }

  /// Finds the torque for which motor and joint move as the shaft allows.
  /// @param free velocity of the joint at the end of the step without this torque [rad/s, m/s]
  /// @param response change of that velocity per torque, >= 0
  /// @return change of the torque
  virtual double solve(double free, double response) = 0;

 protected:
  double torque_ = 0.0;

 private:
  int dof_;
};

}  // namespace anthrob
