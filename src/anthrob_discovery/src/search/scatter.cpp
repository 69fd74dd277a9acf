#include "search/scatter.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace discovery {

namespace {

double total(const Tested& tested) {
  return tested.fit.cost + 0.5 * tested.test.cast<double>().squaredNorm();
}

}  // namespace

double allowing_for_scatter(double by_blocks, const Convergence& convergence, const Tested& base,
                            const Tested& one, const Tested& other, double least) {
  const double lead = total(other) - total(one);
  const double gain = total(base) - std::min(total(one), total(other));
  const double scatter =
      std::max({least * gain, convergence.left_open(one.fit), convergence.left_open(other.fit)});
  const double by_scatter = 0.5 * std::erfc(-lead / scatter * M_SQRT1_2);
  return by_blocks > 0.5 ? std::min(by_blocks, std::max(0.5, by_scatter))
                         : std::max(by_blocks, std::min(0.5, by_scatter));
}

}  // namespace discovery
}  // namespace anthrob
