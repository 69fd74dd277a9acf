#pragma once

namespace anthrob {
namespace driver {

/// How hot a motor's winding is by what it drew, where nothing measures it: heat h follows the
/// power that its resistance takes, with the winding's time constant tau,
///   tau dh/dt = (I / I_n)^2 - h,
/// so that the nominal current I_n leads to 1 in the end. The housing, which warms up far more
/// slowly, counts as at the data sheet's temperature.
class MotorHeat {
 public:
  static constexpr double kLimit = 1.1;       ///< more is too hot
  static constexpr double kCool = 0.9;        ///< less may go on
  static constexpr double kLongestGap = 0.1;  ///< [s] between two measurements; then 0 A counts

  /// @param nominal_current I_n, what the winding stands for ever [A]; 0: not known, never hot
  /// @param time_constant tau of the winding [s]
  MotorHeat(double nominal_current, double time_constant)
      : nominal_(nominal_current), time_constant_(time_constant) {}

  /// One measurement, also of a motor that is off.
  /// @param current [A]   @param now [s]
  void step(double current, double now);

  bool known() const { return nominal_ > 0.0; }
  double heat() const { return heat_; }
  /// Until it has cooled down to kCool without current [s]; 0: it has.
  double time_to_cool() const;

 private:
  double nominal_, time_constant_;
  double heat_ = 0.0;
  double last_ = 0.0;  ///< [s]
  bool begun_ = false;
};

}  // namespace driver
}  // namespace anthrob
