#pragma once

#include <optional>
#include <string>

namespace anthrob {
namespace driver {

/// Detects an encoder that does not count, or counts backwards, although its motor turns. A motor
/// that stands still draws I = V / R, whatever holds it. If it draws less, the difference is
/// back-EMF, so it turns at
///   w = (V - R I) / k   [rad/s]
/// If w shows for kLasts, in one direction, that the motor turns, and the position has changed in
/// that direction by less than kCounted of that, then encoder, motor cable or current sensor is
/// broken or connected the wrong way round.
/// It does not notice this on a motor so slow that its back-EMF is below kLeast.
class EncoderWatch {
 public:
  // Chosen, not measured on a robot. encoder_watch_test shows no alarm for motors at rest with a
  // winding from 20 % cold to 40 % hot and 0.1 A of noise.

  /// [s] At 200 Hz, 40 measurements.
  static constexpr double kLasts = 0.2;
  /// [V] Allows for brushes and power stage; 0.7 rad/s of Anthrob's type_1 motor.
  static constexpr double kLeast = 1.0;
  /// [1] Relative increase of R in a hot winding: copper (0.0039 1/K) that is 100 K warmer.
  static constexpr double kHot = 0.4;
  /// [1] Not 0, so that a flickering count is no motion, and well below 1 for errors of R and k.
  static constexpr double kCounted = 0.1;
  /// [s] between two measurements; after a longer one the watch starts again
  static constexpr double kLongestGap = 0.05;

  /// @param resistance R [ohm] of motor and power stage; 0: not known, nothing is detected
  /// @param back_emf k [Vs/rad] at the gear output
  EncoderWatch(double resistance, double back_emf) : resistance_(resistance), back_emf_(back_emf) {}

  /// One measurement.
  /// @param position [rad]   @param voltage [V] of the controller   @param current [A]
  /// @param now [s]
  /// @return what is wrong, in words
  std::optional<std::string> step(double position, double voltage, double current, double now);
  /// Forgets everything; to be called while the muscle is not enabled.
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
