#include "identification/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace anthrob {
namespace identification {

std::string with_error(const Estimate& estimate, double unit) {
  // Two digits of the error, and the value as far.
  const double sigma = estimate.sigma / unit;
  const int decimals =
      sigma > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(sigma))), 0, 9) : 6;
  char text[80];
  std::snprintf(text, sizeof(text), "%.*f +- %.*f", decimals, estimate.value / unit, decimals,
                sigma);
  return text;
}

}  // namespace identification
}  // namespace anthrob
