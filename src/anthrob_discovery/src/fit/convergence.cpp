#include "fit/convergence.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace anthrob {
namespace discovery {

namespace {

/// Whether a fit might come down to a rival's cost if each of the rounds there are gained as much
/// as the last one.
bool might_reach(double rival, const Fitted& fitted, double gain,
                 const ConvergenceOptions& options) {
  return fitted.cost - (options.rounds + options.finishing_rounds) * gain <= rival;
}

/// A fit's variant with other sizes of its effects, and shapes as they were expected or of the
/// simplest form.
Variant resized(const Fitted& fitted, double factor, bool plain) {
  Variant other = fitted.variant;
  for (const Unknown& u : fitted.unknowns) {
    if (u.effect < 0) continue;
    const double shape = plain ? u.plain.value_or(u.expected) : u.expected;
    const double size = u.read(fitted.variant) - u.neutral.value_or(0.0);
    u.write(u.neutral ? *u.neutral + factor * size : shape, other);
  }
  return other;
}

}  // namespace

bool Convergence::clearly_misses(const Fitted& fitted) const {
  return judge_.gap(fitted.residual) > options().clear_gap;
}

double Convergence::left_open(const Fitted& fitted) const {
  return (clearly_misses(fitted) ? options().roughly_settled : options().at_the_end) * fitted.cost;
}

/// Polishes as long as that reduces the cost. If an effect is clearly missing, the last steps of
/// the model without it are not worth their time.
bool Convergence::converge(Fitted& fitted, double rival, double level) const {
  std::optional<ModelFit::RefreshedJacobian> refreshed;
  for (int k = 0; k < options().rounds; ++k) {
    const bool clear = clearly_misses(fitted);
    const double before = fitted.cost;
    fit_.polish(fitted, options().polish,
                clear ? ModelFit::Slopes::kOneSide : ModelFit::Slopes::kBothSides, &refreshed);
    const double gain = before - fitted.cost;
    if (fitted.cost > level || !might_reach(rival, fitted, gain, options())) return false;
    if (gain < (clear ? options().roughly_settled : options().settled) * before) break;
  }
  return true;
}

Fitted Convergence::converged(const Variant& variant, std::vector<Unknown> unknowns) const {
  Fitted fitted = fit_.start(variant, std::move(unknowns));
  fit_.improve(fitted, options().rough);
  converge(fitted);
  return fitted;
}

bool Convergence::converge_within_reach(Fitted& fitted, double level) const {
  fit_.improve(fitted, options().rough);
  if (fitted.cost > options().hopeless * level) return false;
  fit_.polish(fitted, options().polish, ModelFit::Slopes::kOneSide);
  // Too far above the level for better sensitivities to help.
  if (fitted.cost > level) return false;
  converge(fitted);
  return true;
}

Fitted Convergence::to_the_end(const Fitted& fitted) const {
  return *to_the_end_within_reach(fitted, HUGE_VAL);
}

std::optional<Fitted> Convergence::to_the_end_within_reach(const Fitted& fitted, double level,
                                                           double rival) const {
  std::optional<Fitted> best = roughly_from_given(fitted);
  if (std::min(fitted.cost, best ? best->cost : HUGE_VAL) > level) return std::nullopt;
  bool near = best && converge(*best, rival, options().falls_behind * fitted.cost);
  if (!best || best->cost >= fitted.cost) {
    best = fitted;
    near = converge(*best, rival);
  }
  if (begin_anew(*best)) near = true;
  if (near) finish(*best, rival);
  return best;
}

/// A large effect makes valleys beside the right one: a joint that sticks too often can be had by
/// more friction or by a higher ratio of static friction. Where a fit clearly misses and one of a
/// few other sizes does better at once, fits from there.
bool Convergence::begin_anew(Fitted& fitted) const {
  if (fitted.variant.effects.empty() || !clearly_misses(fitted)) return false;
  std::vector<Variant> others;
  for (const bool plain : {true, false}) {
    for (const double factor : options().other_sizes)
      others.push_back(resized(fitted, factor, plain));
  }
  const std::vector<Eigen::VectorXf> residuals = fit_.residuals(others);
  double least = fitted.residual.squaredNorm();
  const Variant* best = nullptr;
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (residuals[i].size() == 0 || !(residuals[i].squaredNorm() < least)) continue;
    least = residuals[i].squaredNorm();
    best = &others[i];
  }
  if (!best) return false;
  Fitted anew = converged(*best, fitted.unknowns);
  if (anew.cost >= fitted.cost) return false;
  fitted = std::move(anew);
  return true;
}

/// With the sensitivities of the fit, which are good enough for rough steps; with those at the
/// given parameters where no step gains anything by them. Nothing if the effects cannot be
/// simulated with the given parameters.
std::optional<Fitted> Convergence::roughly_from_given(const Fitted& fitted) const {
  Variant given = fitted.variant;
  given.nuisances = evaluator_.initial_nuisances();
  Fitted anew = fitted;
  if (!fit_.move(anew, given)) return std::nullopt;
  const double before = anew.cost;
  fit_.improve(anew, options().rough);
  if (anew.cost < before) return anew;
  anew = fit_.start(given, fitted.unknowns);
  anew.curvatures = fitted.curvatures;
  fit_.improve(anew, options().rough);
  return anew;
}

/// Last iterations: near the minimum, sensitivities of the coarse step no longer reduce the cost,
/// those of the usual step do. Where something is left, their errors do not cancel out over the
/// residual.
void Convergence::finish(Fitted& fitted, double rival) const {
  std::optional<ModelFit::RefreshedJacobian> refreshed;
  for (int k = 0; k < options().finishing_rounds && !clearly_misses(fitted); ++k) {
    const bool left = judge_.gap(fitted.residual) > judge_.options().faint_gap;
    const auto slopes = left ? ModelFit::Slopes::kExactToBothSides : ModelFit::Slopes::kExact;
    const double before = fitted.cost;
    fit_.polish(fitted, options().polish, slopes, &refreshed);
    const double gain = before - fitted.cost;
    if (gain < options().at_the_end * before || !might_reach(rival, fitted, gain, options())) break;
  }
}

}  // namespace discovery
}  // namespace anthrob
