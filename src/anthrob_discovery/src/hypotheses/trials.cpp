#include "hypotheses/trials.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "fit/bounded_minimum.h"
#include "fit/phase.h"

namespace anthrob {
namespace discovery {

namespace {

using Amount = std::vector<double>;  // of each size, in doses

double largest(const Amount& amount) {
  double size = 0.0;
  for (const double a : amount) size = std::max(size, std::abs(a));
  return size;
}

/// The dose itself is among them: a surface that is too small to touch does nothing. So are
/// multiples of it: a strong effect need not look like a weak one.
std::vector<Amount> sizes_to_try(const Amount& suggested, const TrialOptions& options) {
  std::vector<Amount> sizes;
  const double whole = std::max(largest(suggested), 1e-300);  // sizes keep their ratio
  for (const double share : options.suggested) {
    sizes.push_back(suggested);
    for (double& a : sizes.back()) a *= share;
  }
  for (const double doses : options.doses) {
    sizes.push_back(suggested);
    for (double& a : sizes.back()) a = std::copysign(doses, a) * (std::abs(a) / whole);
  }
  return sizes;
}

}  // namespace

std::vector<std::size_t> best_of_kinds(const std::vector<const Effect*>& kinds,
                                       std::size_t of_a_kind, std::size_t most) {
  std::map<const Effect*, std::size_t> count;
  std::vector<std::size_t> best, rest;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    (++count[kinds[i]] <= of_a_kind ? best : rest).push_back(i);
  }
  best.insert(best.end(), rest.begin(), rest.end());
  if (best.size() > most) best.resize(most);
  return best;
}

std::vector<Score> Trials::most_promising(const std::vector<Score>& scores,
                                          const std::vector<Candidate>& candidates) const {
  std::vector<const Effect*> kinds;
  for (std::size_t s = 0; s < scores.size() && scores[s].gain > 0.0; ++s) {
    kinds.push_back(candidates[scores[s].candidate].effect);
  }
  std::vector<Score> tried;
  for (const std::size_t s : best_of_kinds(kinds, options_.tried_of_a_kind, options_.tried)) {
    tried.push_back(scores[s]);
  }
  return tried;
}

/// At the place with the strongest evidence every law is tried: one whose dose seems to change
/// nothing, or to make it worse, may help at a larger size.
void Trials::add_place_of_first(const std::vector<Score>& scores,
                                const std::vector<Candidate>& candidates,
                                std::vector<Score>& tried) const {
  if (tried.empty()) return;
  const std::string place = candidates[tried.front().candidate].owner();
  for (const Score& score : scores) {
    if (candidates[score.candidate].place != place) continue;
    const bool is_in = std::any_of(tried.begin(), tried.end(), [&](const Score& other) {
      return other.candidate == score.candidate;
    });
    if (is_in) continue;
    tried.push_back(score);
    Amount& amount = tried.back().amount;
    if (largest(amount) == 0.0) std::fill(amount.begin(), amount.end(), options_.unasked);
  }
}

std::vector<Trials::Trial> Trials::simulate(const Fitted& base, const std::vector<Score>& tried,
                                            std::vector<Trial> trials) const {
  std::vector<Variant> variants;
  for (const Trial& trial : trials) {
    Variant variant = base.variant;
    variant.effects.push_back(candidates_[tried[trial.owner].candidate].sized(trial.amount));
    variants.push_back(std::move(variant));
  }
  const auto changes = fit_.changes(base.variant, base.residual, variants);
  const Eigen::VectorXd precision = base.precision(), off = base.scaled() - base.expected();
  Eigen::MatrixXd A = (base.sensitivity.transpose() * base.sensitivity).cast<double>();
  A.diagonal() += precision;
  regularise(A);
  const Eigen::VectorXd lower = base.lower_room(), upper = base.upper_room();
  for (std::size_t i = 0; i < trials.size(); ++i) {
    trials[i].cost = HUGE_VAL;
    if (changes[i].size() == 0) continue;  // cannot be simulated at that size
    trials[i].changed = static_cast<double>(changes[i].norm());
    const Eigen::VectorXf residual = base.residual + changes[i];
    const Eigen::VectorXd g =
        (base.sensitivity.transpose() * residual).cast<double>() + precision.cwiseProduct(off);
    trials[i].cost =
        0.5 * residual.cast<double>().squaredNorm() + 0.5 * off.cwiseAbs2().dot(precision);
    if (lower.size() == 0) continue;
    const Eigen::VectorXd step = bounded_minimum(A, g, lower, upper);
    trials[i].cost += 0.5 * step.dot(A * step) + g.dot(step);
  }
  return trials;
}

std::vector<double> Trials::choose_sizes(const Fitted& base, std::vector<Score>& tried) const {
  std::vector<Trial> trials;
  for (std::size_t s = 0; s < tried.size(); ++s) {
    for (Amount& amount : sizes_to_try(tried[s].amount, options_))
      trials.push_back({s, std::move(amount)});
  }
  trials = simulate(base, tried, std::move(trials));

  const std::size_t as_suggested = options_.suggested.size() - 1,
                    the_dose = options_.suggested.size();
  // A law that does nothing up to a size begins somewhere between it and the dose. Where two sizes
  // make up an amplitude and a phase, a small dose may suggest the wrong phase for a large one.
  std::vector<Trial> more;
  const std::size_t sizes = tried.empty() ? 1 : trials.size() / tried.size();
  for (std::size_t i = 0; i < trials.size(); i += sizes) {
    const Trial &some = trials[i + as_suggested], &dose = trials[i + the_dose];
    const double share = largest(some.amount);
    if (share >= 1.0 || some.changed > options_.begun * share * dose.changed) continue;
    for (const double way : options_.between) {
      Trial trial{some.owner, some.amount};
      for (std::size_t k = 0; k < trial.amount.size(); ++k) {
        trial.amount[k] += way * (dose.amount[k] - some.amount[k]);
      }
      more.push_back(std::move(trial));
    }
  }
  for (std::size_t i = 0; i < trials.size(); ++i) {
    // Half of the suggested amount says nothing more about the phase.
    const Candidate& candidate = candidates_[tried[trials[i].owner].candidate];
    if (i % sizes < as_suggested || !has_phase(candidate)) continue;
    for (Amount& amount : other_phases(candidate, trials[i].amount)) {
      more.push_back({trials[i].owner, std::move(amount)});
    }
  }
  if (!more.empty()) more = simulate(base, tried, std::move(more));
  trials.insert(trials.end(), more.begin(), more.end());

  std::vector<double> left(tried.size(), base.cost);
  for (const Trial& trial : trials) {
    if (trial.cost >= left[trial.owner]) continue;
    left[trial.owner] = trial.cost;
    tried[trial.owner].amount = trial.amount;
  }
  return left;
}

std::vector<Score> Trials::best(const Fitted& base, const std::vector<Score>& scores) const {
  std::vector<Score> tried = most_promising(scores, candidates_);
  add_place_of_first(scores, candidates_, tried);
  const std::vector<double> left = choose_sizes(base, tried);
  std::vector<std::size_t> order(tried.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return left[a] < left[b]; });
  // Two names of one place ("the last segment", "segment 3") give the same bits.
  const auto effect = [&](std::size_t s) { return candidates_[tried[s].candidate].effect; };
  const auto same = [&](std::size_t a, std::size_t b) {
    return left[a] < base.cost && left[a] == left[b] && effect(a) == effect(b);
  };
  order.erase(std::unique(order.begin(), order.end(), same), order.end());
  std::vector<const Effect*> kinds;
  for (const std::size_t s : order) kinds.push_back(effect(s));
  std::vector<Score> best;
  for (const std::size_t k : best_of_kinds(kinds, options_.kept_of_a_kind, options_.kept)) {
    best.push_back(std::move(tried[order[k]]));
  }
  return best;
}

}  // namespace discovery
}  // namespace anthrob
