#pragma once

#include <algorithm>
#include <cmath>

namespace anthrob {

struct Colour {
  float r = 0.0f, g = 0.0f, b = 0.0f;  ///< 0 to 1
};

constexpr double kFullColourForce = 40.0;  ///< [N] where the scale of Anthrob's tendons ends

/// Of a tendon in a picture: from blue over green and yellow to red; grey where it is not measured.
/// @param force [N]; NaN: not measured
/// @param full where the scale ends, > 0 [N]
inline Colour force_colour(double force, double full = kFullColourForce) {
  if (std::isnan(force)) return {0.6f, 0.6f, 0.6f};
  const double x = std::clamp(force / full, 0.0, 1.0);
  const double green = x < 2.0 / 3.0 ? std::min(1.0, 0.25 + 2.25 * x) : 3.0 * (1.0 - x);
  return {static_cast<float>(std::clamp(3.0 * x - 1.0, 0.0, 1.0)), static_cast<float>(green),
          static_cast<float>(std::max(0.0, 1.0 - 3.0 * x))};
}

}  // namespace anthrob
