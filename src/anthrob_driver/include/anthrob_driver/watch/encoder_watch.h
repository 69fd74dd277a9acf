#pragma once

#include <string>

namespace anthrob {
namespace driver {

/// Looks for an encoder that does not count though its motor turns. A motor that stands draws
/// I = V / R, whatever holds it; what is missing of that is back-EMF:
///   w = (V - R I) / k   [rad/s]
/// Where that says for kLasts, in one direction, that the motor turns, and the position has moved
/// by less than kCounted of it, somebody is wrong: encoder, motor cable or current sensor.
/// Not seen: a motor so slow that its back-EMF is below kLeast.
class EncoderWatch {
 public:
  static constexpr double kLasts = 0.2;        ///< [s]
  static constexpr double kLeast = 1.0;        ///< [V] brushes and power stage take some, too
  static constexpr double kHot = 0.4;          ///< [1] R of a hot winding is so much larger
  static constexpr double kCounted = 0.1;      ///< [1]
  static constexpr double kLongestGap = 0.05;  ///< [s] between two measurements

  /// @param resistance R [ohm] of motor and power stage; 0: not known, nothing is found
  /// @param back_emf k [Vs/rad] at the gear output
  EncoderWatch(double resistance, double back_emf) : resistance_(resistance), back_emf_(back_emf) {}

  /// One measurement.
  /// @param position [rad]   @param voltage [V] of the controller   @param current [A]
  /// @param now [s]
  /// @return what is wrong, in words; empty: nothing
  std::string step(double position, double voltage, double current, double now);
  /// Forgets all: the muscle was not enabled.
  void restart() { turning_ = 0; }

 private:
  double resistance_, back_emf_;
  int turning_ = 0;                  ///< direction of the back-EMF; 0: too little
  double since_ = 0.0, last_ = 0.0;  ///< [s]
  double start_ = 0.0;               ///< [rad] position at since_
  double turned_ = 0.0;              ///< [rad] since then, by the back-EMF
};

}  // namespace driver
}  // namespace anthrob
