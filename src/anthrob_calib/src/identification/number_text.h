#pragma once

#include <nlohmann/json.hpp>

#include "identification/estimate.h"

namespace anthrob {
namespace identification {

/// `{value, sigma, ci95: [lo, hi], unit}`
inline nlohmann::ordered_json as_json(const Estimate& estimate, const char* unit) {
  return {{"value", estimate.value},
          {"sigma", estimate.sigma},
          {"ci95", {estimate.lo, estimate.hi}},
          {"unit", unit}};
}

/// "0.694 +- 0.003"
std::string with_error(const Estimate& estimate, double unit);

}  // namespace identification
}  // namespace anthrob
