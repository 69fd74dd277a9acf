#include "reference_limits.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace anthrob {

double ReferenceRange::clipped(double value) const {
  return std::min(std::max(value, low), high);
}

ReferenceRange ReferenceRange::with(double value) const {
  return {std::min(low, value), std::max(high, value)};
}

void ReferenceLimits::set(ControlMode mode, double limit) {
  if (!std::isfinite(limit) || limit <= 0.0) return;
  ranges_[mode] = {mode == ControlMode::kForce ? 0.0 : -limit, limit};
}

std::string limit_key(ControlMode mode) {
  std::string key = name_of(mode);
  std::transform(key.begin(), key.end(), key.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return key;
}

}  // namespace anthrob
