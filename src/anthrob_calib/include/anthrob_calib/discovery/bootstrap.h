#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "anthrob_calib/discovery/model_fit.h"

namespace anthrob {
namespace discovery {

/// 95 % interval of every unknown of a fit, in its own unit, by resampling blocks of time with the
/// fit's sensitivities (block bootstrap). Deterministic by seed.
std::vector<std::pair<double, double>> bootstrap_intervals(const Fitted& fitted,
                                                           const Experiments& experiments,
                                                           std::uint64_t seed);

}  // namespace discovery
}  // namespace anthrob
