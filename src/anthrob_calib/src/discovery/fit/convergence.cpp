#include "anthrob_calib/discovery/fit/convergence.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace discovery {

namespace {

constexpr int kRough = 8;           ///< iterations by the first slopes
constexpr int kPolish = 8;          ///< iterations by the same slopes
constexpr int kSurveys = 4;         ///< how often sensitivities are simulated again
constexpr double kSettled = 5e-4;   ///< share of the cost
constexpr double kAtTheEnd = 5e-4;  ///< share of the cost
constexpr int kFinishing = 5;       ///< rounds of exact slopes
constexpr double kClearGap = 2.5;   ///< of all channels together, in floors
constexpr double kRoughlySettled = 0.01;

}  // namespace

bool Convergence::clearly_misses(const Fitted& fitted) const {
  return judge_.gap(fitted.residual) > kClearGap;
}

double Convergence::left_open(const Fitted& fitted) const {
  return (clearly_misses(fitted) ? kRoughlySettled : kAtTheEnd) * fitted.cost;
}

/// Polishes as long as that reduces the cost. If an effect is clearly missing, the last steps of
/// the model without it are not worth their time.
void Convergence::converge(Fitted& fitted) const {
  for (int k = 0; k < kSurveys; ++k) {
    const bool clear = clearly_misses(fitted);
    const double before = fitted.cost;
    fit_.polish(fitted, kPolish, clear ? ModelFit::Slopes::kOneSide : ModelFit::Slopes::kBothSides);
    if (before - fitted.cost < (clear ? kRoughlySettled : kSettled) * before) break;
  }
}

Fitted Convergence::rough(const Variant& variant, std::vector<Unknown> unknowns) const {
  Fitted fitted = fit_.start(variant, std::move(unknowns));
  fit_.improve(fitted, kRough);
  return fitted;
}

Fitted Convergence::converged(const Variant& variant, std::vector<Unknown> unknowns) const {
  Fitted fitted = rough(variant, std::move(unknowns));
  converge(fitted);
  return fitted;
}

bool Convergence::converge_within_reach(Fitted& fitted, double level) const {
  fit_.improve(fitted, kRough);
  fit_.polish(fitted, kPolish, ModelFit::Slopes::kOneSide);
  // Too far above the level for better sensitivities to help.
  if (fitted.cost > level) return false;
  converge(fitted);
  return true;
}

Fitted Convergence::to_the_end(const Fitted& fitted) const {
  return *to_the_end_within_reach(fitted, HUGE_VAL);
}

std::optional<Fitted> Convergence::to_the_end_within_reach(const Fitted& fitted,
                                                           double level) const {
  std::optional<Fitted> best = roughly_from_given(fitted);
  if (std::min(fitted.cost, best ? best->cost : HUGE_VAL) > level) return std::nullopt;
  if (best) converge(*best);
  if (!best || best->cost >= fitted.cost) {
    best = fitted;
    converge(*best);
  }
  finish(*best);
  return best;
}

/// Nothing if the effects cannot be simulated with the given parameters.
std::optional<Fitted> Convergence::roughly_from_given(const Fitted& fitted) const {
  Variant given = fitted.variant;
  given.nuisances = evaluator_.initial_nuisances();
  try {
    return rough(given, fitted.unknowns);
  } catch (const NotSimulated&) {
    return std::nullopt;
  }
}

/// Last iterations: near the minimum, sensitivities of the coarse step no longer reduce the cost,
/// those of the usual step do.
void Convergence::finish(Fitted& fitted) const {
  for (int k = 0; k < kFinishing && !clearly_misses(fitted); ++k) {
    const double before = fitted.cost;
    fit_.polish(fitted, kPolish, ModelFit::Slopes::kExact);
    if (before - fitted.cost < kAtTheEnd * before) break;
  }
}

}  // namespace discovery
}  // namespace anthrob
