#include "fit/model_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "fit/bounded_minimum.h"
#include "fit/slope_steps.h"

namespace anthrob {
namespace discovery {

namespace {

bool is_exact(ModelFit::Slopes slopes) {
  return slopes == ModelFit::Slopes::kExact || slopes == ModelFit::Slopes::kExactToBothSides;
}

std::vector<std::size_t> all_of(const Fitted& fitted) {
  std::vector<std::size_t> all(fitted.unknowns.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// Of a change by one step of the rounding (Channel::rounding) in every bin, the norm [floors].
double rounding_norm(const Experiments& experiments, const Eigen::VectorXf& whitener) {
  double squares = 0.0;
  Eigen::Index offset = 0;
  for (const auto& experiment : experiments) {
    for (const Channel& channel : experiment->channels()) {
      const auto factors = whitener.segment(offset + static_cast<Eigen::Index>(channel.offset),
                                            static_cast<Eigen::Index>(channel.count));
      squares += channel.rounding * channel.rounding * factors.cast<double>().squaredNorm();
    }
    offset += static_cast<Eigen::Index>(experiment->size());
  }
  return std::sqrt(squares);
}

/// Effects, whose scales change, and the ordinary parameters that have moved.
/// @param from where the unknowns were   @param hardly such a step is none [scales]
std::vector<std::size_t> moved_since(const std::vector<double>& from, const Fitted& fitted,
                                     double hardly) {
  std::vector<std::size_t> moved;
  for (std::size_t i = 0; i < fitted.unknowns.size(); ++i) {
    const Unknown& u = fitted.unknowns[i];
    const double way = std::abs(u.read(fitted.variant) - from[i]);
    if (u.effect >= 0 || way > hardly * u.scale) moved.push_back(i);
  }
  return moved;
}

}  // namespace

double Unknown::read(const Variant& variant) const {
  if (nuisance >= 0) return variant.nuisances[static_cast<std::size_t>(nuisance)];
  return variant.effects[static_cast<std::size_t>(effect)].parameters.at(parameter);
}

void Unknown::write(double value, Variant& variant) const {
  value = std::clamp(value, lower, upper);
  if (nuisance >= 0) {
    variant.nuisances[static_cast<std::size_t>(nuisance)] = value;
  } else {
    variant.effects[static_cast<std::size_t>(effect)].parameters[parameter] = value;
  }
}

double Fitted::misfit() const {
  return 0.5 * residual.cast<double>().squaredNorm();
}

Eigen::VectorXd Fitted::scaled() const {
  Eigen::VectorXd x(static_cast<Eigen::Index>(unknowns.size()));
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    x[static_cast<Eigen::Index>(i)] = unknowns[i].read(variant) / unknowns[i].scale;
  }
  return x;
}

Eigen::VectorXd Fitted::expected() const {
  Eigen::VectorXd x(static_cast<Eigen::Index>(unknowns.size()));
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    x[static_cast<Eigen::Index>(i)] = unknowns[i].expected / unknowns[i].scale;
  }
  return x;
}

Eigen::VectorXd Fitted::lower_room() const {
  Eigen::VectorXd room(static_cast<Eigen::Index>(unknowns.size()));
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const Unknown& u = unknowns[i];
    room[static_cast<Eigen::Index>(i)] = std::min(0.0, (u.lower - u.read(variant)) / u.scale);
  }
  return room;
}

Eigen::VectorXd Fitted::upper_room() const {
  Eigen::VectorXd room(static_cast<Eigen::Index>(unknowns.size()));
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const Unknown& u = unknowns[i];
    room[static_cast<Eigen::Index>(i)] = std::max(0.0, (u.upper - u.read(variant)) / u.scale);
  }
  return room;
}

Eigen::VectorXd Fitted::precision() const {
  Eigen::VectorXd p(static_cast<Eigen::Index>(unknowns.size()));
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const Unknown& u = unknowns[i];
    const double sd = u.spread / u.scale;
    p[static_cast<Eigen::Index>(i)] = u.spread > 0.0 ? 1.0 / (sd * sd) : 0.0;
  }
  return p;
}

bool Fitted::at_bound(std::size_t unknown, double share_of_scale) const {
  const Unknown& u = unknowns[unknown];
  const double value = u.read(variant), margin = share_of_scale * u.scale;
  return value <= u.lower + margin || value >= u.upper - margin;
}

std::vector<Unknown> nuisance_unknowns(const Evaluator& evaluator) {
  std::vector<Unknown> unknowns;
  const auto& parameters = evaluator.nuisances();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const ModelParameter& p = parameters[i];
    Unknown u;
    u.nuisance = static_cast<int>(i);
    u.lower = p.lower;
    u.upper = p.upper;
    u.scale = p.step;
    u.expected = p.initial;
    // A uniform distribution over the range has this standard deviation.
    u.spread = p.range() / std::sqrt(12.0);
    unknowns.push_back(u);
  }
  return unknowns;
}

ModelFit ModelFit::part(const Excerpt& excerpt) const {
  return ModelFit(evaluator_, excerpt.experiments, excerpt.of(whitener_), options_, coarse_);
}

ModelFit ModelFit::weighted(const Eigen::VectorXf& factor) const {
  return ModelFit(evaluator_, experiments_, whitener_.cwiseProduct(factor), options_, coarse_);
}

std::vector<Eigen::VectorXf> ModelFit::residuals(const std::vector<Variant>& variants) const {
  auto results = evaluator_.compare(variants, experiments_);
  for (auto& r : results) {
    if (r.size() > 0) r.array() *= whitener_.array();
  }
  return results;
}

std::vector<Eigen::VectorXf> ModelFit::changes(const Variant& from, const Eigen::VectorXf& residual,
                                               std::vector<Variant> to) const {
  std::vector<Eigen::VectorXf> results(to.size());
  if (coarse_ > 0.0) {
    std::vector<Variant> coarse = to;
    coarse.push_back(from);
    for (Variant& variant : coarse) variant.step = coarse_;
    results = residuals(coarse);
    const Eigen::VectorXf base = std::move(results.back());
    results.pop_back();
    for (Eigen::VectorXf& result : results) {
      if (base.size() == 0) result.resize(0);
      if (result.size() > 0) result -= base;
    }
  }
  std::vector<std::size_t> left;  // variants that the coarse step cannot simulate
  std::vector<Variant> again;
  for (std::size_t i = 0; i < to.size(); ++i) {
    if (results[i].size() > 0) continue;
    left.push_back(i);
    again.push_back(std::move(to[i]));
  }
  auto exact = exact_changes(residual, again);
  for (std::size_t k = 0; k < left.size(); ++k) results[left[k]] = std::move(exact[k]);
  return results;
}

std::vector<Eigen::VectorXf> ModelFit::exact_changes(const Eigen::VectorXf& residual,
                                                     const std::vector<Variant>& to) const {
  auto results = residuals(to);
  for (Eigen::VectorXf& result : results) {
    if (result.size() > 0) result -= residual;
  }
  return results;
}

Eigen::VectorXf ModelFit::residual(const Variant& variant) const {
  return residuals({variant}).front();
}

double ModelFit::cost_of(const Fitted& fitted, const Variant& variant,
                         const Eigen::VectorXf& residual) const {
  Fitted other;
  other.variant = variant;
  other.unknowns = fitted.unknowns;
  const Eigen::VectorXd off = other.scaled() - other.expected();
  return 0.5 * residual.cast<double>().squaredNorm() + 0.5 * off.cwiseAbs2().dot(other.precision());
}

void ModelFit::simulate_sensitivity(Fitted& fitted, std::size_t from) const {
  SlopeSteps steps(fitted, options_.slopes);
  for (std::size_t i = from; i < fitted.unknowns.size(); ++i)
    steps.add_one_side(i, options_.slopes.one_side);
  const auto changes = exact_changes(fitted.residual, steps.variants());
  fitted.sensitivity.conservativeResize(fitted.residual.size(),
                                        static_cast<Eigen::Index>(fitted.unknowns.size()));
  steps.take_slopes(changes, fitted);
}

void ModelFit::refresh_jacobian(Fitted& fitted, Slopes slopes,
                                const std::vector<std::size_t>& which) const {
  if (which.empty()) return;
  fitted.curvatures.resize(fitted.unknowns.size());
  SlopeSteps steps(fitted, options_.slopes);
  for (const std::size_t i : which) {
    const double step = fitted.unknowns[i].effect < 0 ? options_.slopes.both_sides
                                                      : options_.slopes.both_sides_of_effect;
    if (slopes == Slopes::kOneSide) {
      steps.add_one_side(i, options_.slopes.one_side);
    } else if (fitted.curvatures[i] && slopes != Slopes::kExactToBothSides) {
      steps.add_one_side(i, step);
    } else {
      steps.add_both_sides(i, step);
    }
  }
  const auto changes = is_exact(slopes)
                           ? exact_changes(fitted.residual, steps.variants())
                           : this->changes(fitted.variant, fitted.residual, steps.variants());
  steps.take_slopes(changes, fitted);
}

Fitted ModelFit::start(const Variant& variant, std::vector<Unknown> unknowns) const {
  Fitted fitted;
  fitted.variant = variant;
  fitted.unknowns = std::move(unknowns);
  fitted.residual = residual(variant);
  if (fitted.residual.size() == 0) {
    throw NotSimulated("the model cannot be simulated with the inputs of the recordings");
  }
  fitted.sensitivity.resize(fitted.residual.size(),
                            static_cast<Eigen::Index>(fitted.unknowns.size()));
  refresh_jacobian(fitted, Slopes::kOneSide, all_of(fitted));
  fitted.cost = cost_of(fitted, variant, fitted.residual);
  return fitted;
}

Fitted ModelFit::extend(const Fitted& fitted, const Variant& variant,
                        const std::vector<Unknown>& more) const {
  Fitted next = fitted;
  const std::size_t before = fitted.unknowns.size();
  next.variant = variant;
  next.unknowns.insert(next.unknowns.end(), more.begin(), more.end());
  const Eigen::VectorXf at = residual(variant);
  if (at.size() == 0) throw NotSimulated("the changed model cannot be simulated");
  next.residual = at;
  next.cost = cost_of(next, variant, at);
  simulate_sensitivity(next, before);
  return next;
}

bool ModelFit::move(Fitted& fitted, const Variant& variant) const {
  Eigen::VectorXf at = residual(variant);
  if (at.size() == 0) return false;
  fitted.variant = variant;
  fitted.residual = std::move(at);
  fitted.cost = cost_of(fitted, variant, fitted.residual);
  return true;
}

void ModelFit::renew_effects(Fitted& fitted) const {
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < fitted.unknowns.size(); ++i) {
    if (fitted.unknowns[i].effect >= 0) which.push_back(i);
  }
  refresh_jacobian(fitted, Slopes::kExact, which);
}

void ModelFit::polish(Fitted& fitted, int iterations, Slopes slopes,
                      std::optional<RefreshedJacobian>* before) const {
  for (Unknown& u : fitted.unknowns) {
    // Close to the minimum, small changes are more exact than large ones.
    if (u.effect < 0) continue;
    const double size = u.read(fitted.variant) - u.neutral.value_or(0.0);
    u.scale = std::max({options_.convergence.narrower * u.scale,
                        options_.convergence.scale_of_size * std::abs(size), u.finest});
  }
  const bool again = before && *before && (*before)->slopes == slopes;
  const std::vector<std::size_t> which =
      again ? moved_since((*before)->at, fitted, options_.slopes.hardly_moved) : all_of(fitted);
  refresh_jacobian(fitted, slopes, which);
  if (before) {
    if (!again) *before = RefreshedJacobian{slopes, std::vector<double>(fitted.unknowns.size())};
    for (const std::size_t i : which) (*before)->at[i] = fitted.unknowns[i].read(fitted.variant);
  }
  const Eigen::VectorXd start = fitted.scaled();
  improve(fitted, iterations,
          is_exact(slopes) ? options_.convergence.finished : options_.convergence.polished);
  extend_line(fitted, fitted.scaled() - start);
}

void ModelFit::extend_line(Fitted& fitted, Eigen::VectorXd step) const {
  if (step.size() == 0 || step.isZero()) return;
  for (;; step *= 2.0) {
    Trial trial = try_step(fitted, step);
    if (!(trial.cost < fitted.cost)) return;
    fitted.variant = std::move(trial.variant);
    fitted.residual = std::move(trial.residual);
    fitted.cost = trial.cost;
  }
}

ModelFit::Trial ModelFit::try_step(const Fitted& fitted, const Eigen::VectorXd& step) const {
  Trial trial{fitted.variant, step, {}, HUGE_VAL};
  const Eigen::VectorXd x = fitted.scaled();
  for (Eigen::Index i = 0; i < step.size(); ++i) {
    const Unknown& u = fitted.unknowns[static_cast<std::size_t>(i)];
    u.write((x[i] + step[i]) * u.scale, trial.variant);
  }
  trial.residual = residual(trial.variant);
  if (trial.residual.size() > 0) trial.cost = cost_of(fitted, trial.variant, trial.residual);
  return trial;
}

void ModelFit::improve(Fitted& fitted, int iterations) const {
  improve(fitted, iterations, options_.convergence.enough);
}

void ModelFit::improve(Fitted& fitted, int iterations, double enough, double rival) const {
  const auto n = static_cast<Eigen::Index>(fitted.unknowns.size());
  if (n == 0) return;
  std::size_t first_effect = 0;
  while (first_effect < fitted.unknowns.size() && fitted.unknowns[first_effect].nuisance >= 0) {
    ++first_effect;
  }
  const std::size_t full_steps = options_.damping.full_steps.size();
  const double rounding = rounding_norm(experiments_, whitener_);
  std::size_t lightest = 0;  // damping that may lead on
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const Eigen::MatrixXd information =
        (fitted.sensitivity.transpose() * fitted.sensitivity).cast<double>();
    const Eigen::VectorXd x = fitted.scaled(), precision = fitted.precision();
    const Eigen::VectorXd gradient =
        (fitted.sensitivity.transpose() * fitted.residual).cast<double>() +
        precision.cwiseProduct(x - fitted.expected());
    const Eigen::VectorXd lower = fitted.lower_room(), upper = fitted.upper_room();
    // Full steps first, with more damping if the gain falls short of the prediction; shorter or
    // heavily damped ones only if none of these gains anything.
    Trial best;
    best.cost = fitted.cost;
    std::size_t taken = 0;
    for (std::size_t w = lightest; w < full_steps + options_.damping.last_resort.size(); ++w) {
      const bool last_resort = w >= full_steps;
      const double damping = last_resort ? options_.damping.last_resort[w - full_steps]
                                         : options_.damping.full_steps[w];
      const double length =
          last_resort ? options_.damping.last_resort_lengths[w - full_steps] : 1.0;
      if (last_resort && best.step.size() > 0) break;
      Eigen::MatrixXd system = information;
      system.diagonal() += precision;
      system.diagonal() += damping * information.diagonal();
      system.diagonal().array() += 1e-9 * (1.0 + information.diagonal().maxCoeff());
      const Eigen::VectorXd step = length * bounded_minimum(system, gradient, lower, upper);
      Trial trial = try_step(fitted, step);
      const double promised =
          -(gradient.dot(step) + 0.5 * step.dot(information * step + precision.cwiseProduct(step)));
      const bool kept = fitted.cost - trial.cost > options_.damping.linear_enough * promised;
      if (trial.cost < best.cost) {
        best = std::move(trial);
        taken = w;
      }
      if (kept) break;
    }
    if (best.step.size() == 0) break;
    // Where a light damping led nowhere, so it does from the next point; but one is tried again.
    lightest = std::clamp<std::size_t>(taken, 1, full_steps - 1) - 1;
    const double gain = fitted.cost - best.cost;
    // New slopes after the first iteration may bring more than it did.
    const bool hopeless = iteration > 0 && best.cost - (iterations - iteration - 1) * gain > rival;
    const bool done = hopeless || gain < enough * best.cost;
    // Broyden's update, from what the step really changed; a step that changes hardly anything would
    // leave only what rounding makes of it.
    const Eigen::VectorXf step = best.step.cast<float>();
    const Eigen::VectorXf change = best.residual - fitted.residual;
    const double hardly = options_.convergence.rounded.value * fitted.residual.norm() + rounding;
    if (change.norm() > hardly) {
      const Eigen::VectorXf surprise = change - fitted.sensitivity * step;
      fitted.sensitivity += surprise * (step.transpose() / step.squaredNorm());
    }
    fitted.variant = std::move(best.variant);
    fitted.residual = std::move(best.residual);
    fitted.cost = best.cost;
    if (!done && iteration == 0 && first_effect < fitted.unknowns.size()) {
      simulate_sensitivity(fitted, first_effect);
    }
    if (done) break;
  }
}

}  // namespace discovery
}  // namespace anthrob
