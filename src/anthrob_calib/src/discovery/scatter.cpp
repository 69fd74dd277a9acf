#include "anthrob_calib/discovery/scatter.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace discovery {

namespace {

constexpr double kScatter = 0.01;  ///< share of the better one's gain, by which ends of fits differ

double total(const Tested& tested) {
  return tested.fit.cost + 0.5 * tested.test.cast<double>().squaredNorm();
}

}  // namespace

double allowing_for_scatter(double by_blocks, const Settling& settling, const Tested& base,
                            const Tested& one, const Tested& other) {
  const double lead = total(other) - total(one);
  const double gain = total(base) - std::min(total(one), total(other));
  const double scatter = std::max(
      {kScatter * gain, settling.left_open(one.fit), settling.left_open(other.fit)});
  const double by_scatter = 0.5 * std::erfc(-lead / scatter * M_SQRT1_2);
  return by_blocks > 0.5 ? std::min(by_blocks, std::max(0.5, by_scatter))
                         : std::max(by_blocks, std::min(0.5, by_scatter));
}

}  // namespace discovery
}  // namespace anthrob
