#include "anthrob_calib/discovery/settling.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace discovery {

namespace {

constexpr int kRough = 8;           ///< iterations by the first slopes
constexpr int kPolish = 8;          ///< iterations by the same slopes
constexpr int kSettling = 4;        ///< times that slopes are simulated anew
constexpr double kSettled = 5e-4;   ///< share of the cost
constexpr double kAtTheEnd = 5e-4;  ///< share of the cost
constexpr int kFinishing = 5;       ///< rounds of exact slopes
constexpr double kClearGap = 2.5;   ///< of all channels together, in floors
constexpr double kRoughlySettled = 0.01;

}  // namespace

bool Settling::clearly_misses(const Fitted& fitted) const {
  return judge_.gap(fitted.residual) > kClearGap;
}

double Settling::left_open(const Fitted& fitted) const {
  return (clearly_misses(fitted) ? kRoughlySettled : kAtTheEnd) * fitted.cost;
}

/// Polishes as long as that brings something. Where something is clearly missing, the last steps to
/// a model without it are not worth their time.
void Settling::settle(Fitted& fitted) const {
  for (int k = 0; k < kSettling; ++k) {
    const bool clear = clearly_misses(fitted);
    const double before = fitted.cost;
    fit_.polish(fitted, kPolish, clear ? ModelFit::Slopes::kOneSide : ModelFit::Slopes::kBothSides);
    if (before - fitted.cost < (clear ? kRoughlySettled : kSettled) * before) break;
  }
}

Fitted Settling::rough(const Variant& variant, std::vector<Unknown> unknowns) const {
  Fitted fitted = fit_.start(variant, std::move(unknowns));
  fit_.improve(fitted, kRough);
  return fitted;
}

Fitted Settling::settled(const Variant& variant, std::vector<Unknown> unknowns) const {
  Fitted fitted = rough(variant, std::move(unknowns));
  settle(fitted);
  return fitted;
}

bool Settling::settle_within_reach(Fitted& fitted, double level) const {
  fit_.improve(fitted, kRough);
  fit_.polish(fitted, kPolish, ModelFit::Slopes::kOneSide);
  // So far off that no better derivative brings it there.
  if (fitted.cost > level) return false;
  settle(fitted);
  return true;
}

Fitted Settling::to_the_end(const Fitted& fitted) const {
  return *to_the_end_within_reach(fitted, HUGE_VAL);
}

std::optional<Fitted> Settling::to_the_end_within_reach(const Fitted& fitted, double level) const {
  std::optional<Fitted> best = roughly_from_given(fitted);
  if (std::min(fitted.cost, best ? best->cost : HUGE_VAL) > level) return std::nullopt;
  if (best) settle(*best);
  if (!best || best->cost >= fitted.cost) {
    best = fitted;
    settle(*best);
  }
  finish(*best);
  return best;
}

/// Nothing if the effects cannot be simulated with the given parameters.
std::optional<Fitted> Settling::roughly_from_given(const Fitted& fitted) const {
  Variant given = fitted.variant;
  given.nuisances = evaluator_.initial_nuisances();
  try {
    return rough(given, fitted.unknowns);
  } catch (const NotSimulated&) {
    return std::nullopt;
  }
}

/// The last of it: where a fit has settled, the coarse step's slopes lead nowhere, but the
/// simulation's own do.
void Settling::finish(Fitted& fitted) const {
  for (int k = 0; k < kFinishing && !clearly_misses(fitted); ++k) {
    const double before = fitted.cost;
    fit_.polish(fitted, kPolish, ModelFit::Slopes::kExact);
    if (before - fitted.cost < kAtTheEnd * before) break;
  }
}

}  // namespace discovery
}  // namespace anthrob
