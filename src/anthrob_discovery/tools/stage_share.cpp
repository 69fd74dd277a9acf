#include "stage_share.h"

#include <algorithm>

namespace anthrob {
namespace discovery {

namespace {

constexpr double kAlways = 4.0;      // stages: ordinary parameters, screening, detectability, gap
constexpr double kForEffect = 3.0;   // stages: screening, the short list, are others still needed
constexpr double kUsualShare = 0.9;  // that is done with as many

}  // namespace

double share_of_stages(std::size_t done, int max_effects) {
  const double usual = kAlways + kForEffect * std::max(1, max_effects);
  const auto count = static_cast<double>(done);
  if (count <= usual) return kUsualShare * count / usual;
  return 1.0 - (1.0 - kUsualShare) * usual / count;
}

}  // namespace discovery
}  // namespace anthrob
