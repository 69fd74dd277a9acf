#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "options/judgement.h"

namespace anthrob {
namespace discovery {

/// Part of a channel's squared gap above the square of a level, at least 0. [floors^2]
inline double excess(double gap, double least) {
  return std::max(0.0, gap * gap - least * least);
}

/// Gain in held-out log score that an effect needs to be named [nat]. It grows with the number of
/// candidates that were searched.
inline double needed_evidence(std::size_t candidates, const MeritOptions& options) {
  return options.evidence + std::log(static_cast<double>(std::max<std::size_t>(1, candidates)));
}

}  // namespace discovery
}  // namespace anthrob
