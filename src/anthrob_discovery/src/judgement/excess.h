#pragma once

#include <algorithm>

namespace anthrob {
namespace discovery {

/// Part of a channel's squared gap above the square of a level, at least 0. [floors^2]
inline double excess(double gap, double least) {
  return std::max(0.0, gap * gap - least * least);
}

}  // namespace discovery
}  // namespace anthrob
