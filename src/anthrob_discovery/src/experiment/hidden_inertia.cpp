#include "experiment/hidden_inertia.h"

#include <cmath>

namespace anthrob {
namespace discovery {

namespace {

/// Of half the sum of squares, at a factor.
struct Derivatives {
  double first = 0.0, second = 0.0;
};

Derivatives derivatives_at(const std::vector<InertialBin>& bins, double factor) {
  Derivatives d;
  for (const InertialBin& bin : bins) {
    const double more = (factor - 1.0) * bin.inertial;
    const double left = beyond_zero(bin.low + more, bin.high + more);
    if (left == 0.0) continue;
    d.first += left * bin.inertial;
    d.second += bin.inertial * bin.inertial;
  }
  return d;
}

}  // namespace

double best_factor(const std::vector<InertialBin>& bins, const AxisOptions& options) {
  double squares = 0.0;
  for (const InertialBin& bin : bins) squares += bin.inertial * bin.inertial;
  if (!(squares > 0.0)) return 1.0;
  if (derivatives_at(bins, 0.0).first >= 0.0) return 0.0;
  double low = 0.0, high = 1.0;
  while (derivatives_at(bins, high).first < 0.0 && high < options.most_inertia) {
    low = high;
    high *= 2.0;
  }
  double factor = high;
  for (int i = 0; i < options.inertia_steps && high - low > options.inertia_settled * high; ++i) {
    const Derivatives d = derivatives_at(bins, factor);
    if (d.first == 0.0) break;
    (d.first < 0.0 ? low : high) = factor;
    const double newton = d.second > 0.0 ? factor - d.first / d.second : low;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (std::abs(next - factor) <= options.inertia_settled * high) return next;
    factor = next;
  }
  return factor;
}

}  // namespace discovery
}  // namespace anthrob
