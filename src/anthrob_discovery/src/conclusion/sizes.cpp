#include "conclusion/sizes.h"

#include <tuple>
#include <utility>

#include "fit/bootstrap.h"
#include "fit/flat_range.h"

namespace anthrob {
namespace discovery {

namespace {

using Interval = std::pair<double, double>;

/// Whether only the bound of its range keeps a size from going on. Where nothing is, it does not.
bool is_at_end(double value, const Unknown& u) {
  const double close = 1e-6 * (u.upper - u.lower);
  return (value <= u.lower + close && u.lower != 0.0) ||
         (value >= u.upper - close && u.upper != 0.0);
}

/// A parameter of an effect that was fitted as the unknown `i`.
FoundParameter fitted_parameter(const Hypotheses& hypotheses, const Fitted& fit, std::size_t i,
                                const EffectParameter& p, double value, const Interval& range) {
  const Unknown& u = fit.unknowns[i];
  FoundParameter found{p.name, p.unit, value, value, value, false, false};
  const bool flat = is_flat(fit, i, hypotheses.options.fit.intervals);
  std::tie(found.low, found.high) = flat ? flat_range(hypotheses.train, fit, i) : range;
  const bool spans = found.low <= u.lower && found.high >= u.upper;
  found.at_bound = spans && is_at_end(value, u);
  found.undetermined = spans && !found.at_bound;
  // Where nothing is, no range ends: there is no less than that.
  found.low_ends = found.low <= u.lower && u.lower != 0.0;
  found.high_ends = found.high >= u.upper && u.upper != 0.0;
  return found;
}

}  // namespace

std::vector<std::vector<FoundParameter>> measure_sizes(
    const Hypotheses& hypotheses, const std::vector<MeasuredVariable>& variables,
    const SearchResult& search, std::uint64_t seed) {
  std::vector<std::vector<FoundParameter>> sizes(search.named.size());
  if (search.named.empty()) return sizes;
  // The last steps have blurred them: what depends on nothing must not seem to.
  Fitted fit = search.extended.fit;
  hypotheses.train.renew_effects(fit);
  const auto ranges =
      bootstrap_intervals(fit, hypotheses.train.experiments(), variables, seed,
                          hypotheses.options.fit, hypotheses.options.judgement.block);
  for (std::size_t e = 0; e < search.named.size(); ++e) {
    const Candidate& candidate = hypotheses.candidates[search.named[e].candidate];
    for (const EffectParameter& p : candidate.parameters) {
      const double value = fit.variant.effects[e].parameters.at(p.name);
      FoundParameter found{p.name, p.unit, value, value, value, true, false};
      for (std::size_t i = 0; i < ranges.size(); ++i) {
        const Unknown& u = fit.unknowns[i];
        if (u.effect != static_cast<int>(e) || u.parameter != p.name) continue;
        found = fitted_parameter(hypotheses, fit, i, p, value, ranges[i]);
      }
      sizes[e].push_back(std::move(found));
    }
  }
  return sizes;
}

}  // namespace discovery
}  // namespace anthrob
