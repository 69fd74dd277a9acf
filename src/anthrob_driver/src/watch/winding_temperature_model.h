#pragma once

namespace anthrob {
namespace driver {

/// Estimates from the current how hot a motor's winding is, since nothing measures it. The winding
/// temperature rise relative to that at nominal current, h [1], follows the power in the winding's
/// resistance with the winding's time constant tau,
///   tau dh/dt = (I / I_n)^2 - h,
/// so a constant nominal current I_n leads to h = 1. The housing warms up far more slowly; it is
/// taken to stay at the temperature of the data sheet.
class WindingTemperatureModel {
 public:
  /// [1] h above which the motors are stopped. Chosen: a motor at its nominal current reaches 1 and
  /// must not stop.
  static constexpr double kLimit = 1.1;
  /// [1] h below which they may be enabled again. Chosen: below the 1 of the nominal current.
  static constexpr double kCool = 0.9;
  /// [s] between two measurements; beyond, 0 A is assumed
  static constexpr double kLongestGap = 0.1;

  /// @param nominal_current I_n, continuously permissible [A]; 0: not known, never hot
  /// @param time_constant tau of the winding [s]
  WindingTemperatureModel(double nominal_current, double time_constant)
      : nominal_(nominal_current), time_constant_(time_constant) {}

  /// One measurement, also of a motor that is off.
  /// @param current [A]   @param now [s]
  void step(double current, double now);

  bool known() const { return nominal_ > 0.0; }
  /// h [1]
  double relative_temperature_rise() const { return rise_; }
  /// [s] until it has cooled down to kCool without current; 0 if it has already.
  double time_to_cool() const;

 private:
  double nominal_, time_constant_;
  double rise_ = 0.0;  ///< h
  double last_ = 0.0;  ///< [s]
  bool begun_ = false;
};

}  // namespace driver
}  // namespace anthrob
