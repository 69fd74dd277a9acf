#pragma once

#include <array>
#include <cstddef>

namespace anthrob {
namespace driver {

/// Rate of change of a quantity that is measured in counts: the slope of the straight line through
/// its last values. For potentiometers at 100 Hz (1.3 mrad per count) its error is about 0.01
/// rad/s, that of a difference of two values 0.1 rad/s. It is 25 ms late.
class Slope {
 public:
  static constexpr std::size_t kWindow = 6;
  static constexpr double kLongestGap = 0.1;  ///< [s]; after a longer gap older values are dropped

  /// @param t [s] of a clock that never jumps
  void add(double t, double value);
  /// [unit/s]; NaN while less than two values are known.
  double rate() const;

 private:
  struct Point {
    double t, value;
  };
  std::array<Point, kWindow> points_{};  ///< the oldest first
  std::size_t count_ = 0;
};

}  // namespace driver
}  // namespace anthrob
