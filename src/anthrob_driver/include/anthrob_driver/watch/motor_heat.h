#pragma once

namespace anthrob {
namespace driver {

/// Estimates from the current how hot a motor's winding is, since nothing measures it. The heat h
/// follows the power in the winding's resistance with the winding's time constant tau,
///   tau dh/dt = (I / I_n)^2 - h,
/// so a constant nominal current I_n leads to h = 1. The housing warms up far more slowly; it is
/// taken to stay at the temperature of the data sheet.
class MotorHeat {
 public:
  static constexpr double kLimit = 1.1;  ///< heat above which the motors are stopped
  static constexpr double kCool = 0.9;   ///< heat below which they may be enabled again
  static constexpr double kLongestGap =
      0.1;  ///< [s] between two measurements; beyond, 0 A is assumed

  /// @param nominal_current I_n, what the winding withstands for ever [A]; 0: not known, never hot
  /// @param time_constant tau of the winding [s]
  MotorHeat(double nominal_current, double time_constant)
      : nominal_(nominal_current), time_constant_(time_constant) {}

  /// One measurement, also of a motor that is off.
  /// @param current [A]   @param now [s]
  void step(double current, double now);

  bool known() const { return nominal_ > 0.0; }
  double heat() const { return heat_; }
  /// [s] until it has cooled down to kCool without current; 0 if it has already.
  double time_to_cool() const;

 private:
  double nominal_, time_constant_;
  double heat_ = 0.0;
  double last_ = 0.0;  ///< [s]
  bool begun_ = false;
};

}  // namespace driver
}  // namespace anthrob
