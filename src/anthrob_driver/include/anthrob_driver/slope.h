#pragma once

#include <array>
#include <cstddef>

namespace anthrob {
namespace driver {

/// How fast a quantity changes that is measured in counts: slope of the straight line through its
/// last values. With potentiometers at 100 Hz (1.3 mrad a count) that is good to 0.01 rad/s, a
/// difference of two values to 0.1 rad/s; it comes 25 ms late.
class Slope {
 public:
  static constexpr std::size_t kWindow = 6;
  static constexpr double kLongestGap = 0.1;  ///< [s]; beyond it the past says nothing

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
