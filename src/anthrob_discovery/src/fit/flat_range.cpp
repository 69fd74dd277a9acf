#include "fit/flat_range.h"

#include <cmath>

#include "judgement/quantiles.h"

namespace anthrob {
namespace discovery {

namespace {

/// Where the misfit has risen between the fit and a bound; the bound if it does not. Expectations,
/// which no recording shows, do not count.
double edge(const ModelFit& fit, const Fitted& fitted, const Unknown& unknown, double bound) {
  const double rise = rise_at_ends(fit.options().intervals.confidence);
  const auto stays = [&](double value) {
    Fitted moved = fitted;
    Variant variant = fitted.variant;
    unknown.write(value, variant);
    return fit.move(moved, variant) && moved.misfit() - fitted.misfit() < rise;
  };
  if (stays(bound)) return bound;
  double inside = unknown.read(fitted.variant), outside = bound;
  const double exact = fit.options().intervals.exact * (unknown.upper - unknown.lower);
  while (std::abs(outside - inside) > exact) {
    const double middle = 0.5 * (inside + outside);
    (stays(middle) ? inside : outside) = middle;
  }
  return outside;
}

}  // namespace

bool is_flat(const Fitted& fitted, std::size_t unknown, const IntervalOptions& options) {
  const Unknown& u = fitted.unknowns[unknown];
  const double slope = fitted.sensitivity.col(static_cast<Eigen::Index>(unknown)).norm();
  return slope * (u.upper - u.lower) / u.scale < options.nothing;
}

std::pair<double, double> flat_range(const ModelFit& fit, const Fitted& fitted,
                                     std::size_t unknown) {
  const Unknown& u = fitted.unknowns[unknown];
  return {edge(fit, fitted, u, u.lower), edge(fit, fitted, u, u.upper)};
}

}  // namespace discovery
}  // namespace anthrob
