#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

namespace anthrob::reference {

/// @throws std::invalid_argument naming condition and value if `holds` is false
inline void require(bool holds, const std::string& condition, double value) {
  if (!holds) {
    throw std::invalid_argument("expected " + condition + ", got " + std::to_string(value));
  }
}

inline void require_positive(const std::string& name, double value) {
  require(std::isfinite(value) && value > 0.0, name + " > 0", value);
}

inline void require_not_negative(const std::string& name, double value) {
  require(std::isfinite(value) && value >= 0.0, name + " >= 0", value);
}

}  // namespace anthrob::reference
