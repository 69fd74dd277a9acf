#include "dosing.h"

#include <algorithm>
#include <cmath>

namespace anthrob::virtual_robot {

double dose(const std::function<double(double)>& change, double target, double least, double most,
            int tries) {
  constexpr double kNear = 0.12;      // of the logarithm
  constexpr double kSmallest = 1e-6;  // of a change, so that it has a logarithm
  double factor = std::clamp(1.0, least, most);
  double slope = 1.0;
  double last_x = 0.0, last_y = 0.0;
  double too_little = 0.0, too_much = HUGE_VAL;
  double best = factor, off = HUGE_VAL;
  for (int k = 0; k < tries; ++k) {
    const double x = std::log(factor);
    const double y = std::log(std::max(change(factor), kSmallest) / target);
    if (std::abs(y) < off) {
      off = std::abs(y);
      best = factor;
    }
    if (off < kNear) break;
    (y < 0.0 ? too_little : too_much) = factor;
    if (k > 0 && std::abs(x - last_x) > 1e-3) {
      slope = std::clamp((y - last_y) / (x - last_x), 0.5, 3.0);
    }
    last_x = x;
    last_y = y;
    double next = std::clamp(std::exp(x - y / slope), least, most);
    // Where it does nothing up to a threshold the secant would leap from side to side.
    if (next != factor && (next <= too_little || next >= too_much)) {
      next = std::sqrt(std::max(too_little, least) * std::min(too_much, most));
    }
    if (next == factor) break;
    factor = next;
  }
  return best;
}

}  // namespace anthrob::virtual_robot
