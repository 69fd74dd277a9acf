#pragma once

namespace anthrob {

/// Root of a non-decreasing function, bracketed by two points.
/// @return x with |f(x)| <= tolerance, or as near as rounding allows
template <class Function>
double rising_root(const Function& f, double low, double high, double tolerance) {
  double f_low = f(low), f_high = f(high);
  if (f_low >= 0.0) return low;
  if (f_high <= 0.0) return high;
  for (int i = 0; i < 100; ++i) {
    // Regula falsi, Illinois variant: the value at the end that stays is halved.
    const double x = high - f_high * (high - low) / (f_high - f_low);
    const double value = f(x);
    if (value <= tolerance && value >= -tolerance) return x;
    if (!(x > low && x < high)) return x;
    if (value > 0.0) {
      high = x, f_high = value, f_low *= 0.5;
    } else {
      low = x, f_low = value, f_high *= 0.5;
    }
  }
  return 0.5 * (low + high);
}

}  // namespace anthrob
