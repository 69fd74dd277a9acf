#include "hypotheses/candidate_comparison.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"
#include "fit/phase.h"
#include "hypotheses/trials.h"

namespace anthrob {
namespace discovery {

namespace {

std::vector<Unknown> unknowns_of(const Candidate& candidate, const EffectInstance& start,
                                 int effect, const UnknownOptions& options) {
  std::vector<Unknown> unknowns;
  for (const EffectParameter& p : candidate.parameters) {
    if (p.kind == EffectParameter::kGiven) continue;
    const double value = start.parameters.at(p.name);
    const double dose = std::abs(p.typical - (p.kind == EffectParameter::kSize ? p.neutral : 0.0));
    Unknown u;
    u.effect = effect;
    u.parameter = p.name;
    u.lower = std::max(p.bounds.lo, value - options.largest * dose);
    u.upper = std::min(p.bounds.hi, value + options.largest * dose);
    if (p.bounds.lo_open) u.lower += options.inside * dose;
    if (p.bounds.hi_open) u.upper -= options.inside * dose;
    if (p.kind == EffectParameter::kSize) {
      u.neutral = p.neutral;
      u.scale =
          std::max(options.scale_of_size * std::abs(value - p.neutral), options.least_scale * dose);
      u.finest = options.finest_scale * dose;
    } else {
      // With an unknown sign, nothing can be expected.
      const bool either = p.bounds.lo < 0.0 && p.bounds.hi > 0.0;
      u.scale = options.scale_of_shape * dose;
      u.finest = options.finest_of_shape * dose;
      u.expected = either ? p.neutral : p.typical;
      u.plain = p.neutral;
      u.spread = (either ? options.spread_of_either_sign : options.spread_of_shape) * dose;
    }
    unknowns.push_back(u);
  }
  return unknowns;
}

/// Of a PathEffect: "MUSCLE" is everywhere on it, "MUSCLE/2" one place of it.
bool contains(const std::string& wide, const std::string& narrow) {
  return narrow.size() > wide.size() && narrow.compare(0, wide.size(), wide) == 0 &&
         narrow[wide.size()] == '/';
}

/// Whether a law becomes that one, or one that becomes it, where a shape ends.
bool is_limit_of(const std::string& id, const EffectInfo& law) {
  if (law.limit == id) return true;
  const Effect* next = law.limit.empty() ? nullptr : find_effect(law.limit);
  return next && is_limit_of(id, next->info());
}

}  // namespace

bool is_nested_in(const Candidate& part, const Candidate& whole) {
  const EffectInfo &a = part.effect->info(), &b = whole.effect->info();
  if (part.place != whole.place || a.seam != b.seam) return false;
  return part.sizes().size() < whole.sizes().size() || is_limit_of(a.id, b);
}

double share_of_simpler(const Candidate& part, const Candidate& whole,
                        const ComparisonOptions& options) {
  if (is_nested_in(part, whole)) return options.most_of_it;
  const EffectInfo &a = part.effect->info(), &b = whole.effect->info();
  const bool everywhere = dynamic_cast<const PathEffect*>(part.effect) != nullptr;
  return everywhere && a.id == b.id && contains(part.place, whole.place) ? double{options.all_of_it}
                                                                         : 1.0;
}

FittedCandidate CandidateComparison::fit(const Fitted& base, std::size_t index,
                                         const EffectInstance& start) const {
  FittedCandidate named;
  named.candidate = index;
  named.fit = begin(base, {{index, start}});
  train_.improve(named.fit, options_.comparison.first_iterations);
  return named;
}

double CandidateComparison::least_gain(const Fitted& fitted) const {
  return std::min<double>(train_.options().convergence.enough,
                          options_.comparison.telling_gain / fitted.cost);
}

Fitted CandidateComparison::begin(const Fitted& base, const std::vector<Start>& starts) const {
  Variant variant = base.variant;
  Fitted from = base;
  std::vector<Unknown> more;
  for (const auto& [index, start] : starts) {
    const Candidate& candidate = candidates_[index];
    const auto effect = static_cast<int>(variant.effects.size());
    variant.effects.push_back(start);
    const std::vector<Unknown> its = unknowns_of(candidate, start, effect, options_.unknowns);
    more.insert(more.end(), its.begin(), its.end());
    for (const int nuisance : candidate.same_as) {
      for (Unknown& u : from.unknowns) {
        if (u.nuisance != nuisance) continue;
        u.lower = u.upper = u.expected;
        u.write(u.expected, variant);
      }
    }
  }
  return train_.extend(from, variant, more);
}

Tested CandidateComparison::together(const Tested& base, const std::vector<Score>& parts) const {
  std::vector<Start> starts;
  for (const Score& part : parts) {
    starts.push_back({part.candidate, candidates_[part.candidate].sized(part.amount)});
  }
  Tested all;
  all.fit = begin(base.fit, starts);
  train_.improve(all.fit, options_.comparison.iterations, least_gain(all.fit));
  all.test = test_.residual(all.fit.variant);
  return all;
}

CandidateComparison::Odds CandidateComparison::odds(const Eigen::VectorXf& one_test,
                                                    const Eigen::VectorXf& other_test) const {
  const bool other_is_better = other_test.squaredNorm() < one_test.squaredNorm();
  const Eigen::MatrixXd scores =
      test_judge_.block_scores({one_test, other_test}, other_is_better ? 1 : 0);
  return {model_probabilities(scores, {0.0, 0.0}, seed_, test_judge_.options())[0],
          (scores.row(0) - scores.row(1)).sum()};
}

void CandidateComparison::judge(const Tested& base, ShortList& list) const {
  std::vector<Eigen::VectorXf> train = {base.fit.residual}, test = {base.test};
  for (const FittedCandidate& named : list.entries) {
    train.push_back(named.fit.residual);
    test.push_back(named.test);
  }
  std::size_t best = 0;
  double least = train[0].squaredNorm() + test[0].squaredNorm();
  for (std::size_t i = 1; i < train.size(); ++i) {
    const double size = train[i].squaredNorm() + test[i].squaredNorm();
    if (size < least) {
      least = size;
      best = i;
    }
  }
  const Eigen::MatrixXd on_train = train_judge_.block_scores(train, best);
  const Eigen::MatrixXd on_test = test_judge_.block_scores(test, best);
  Eigen::MatrixXd all(on_train.rows(), on_train.cols() + on_test.cols());
  all << on_train, on_test;

  // Each unknown costs half a log of the number of blocks; having looked at many candidates costs
  // the logarithm of their number.
  std::vector<double> handicap = {0.0};
  for (const FittedCandidate& named : list.entries) {
    const auto more = static_cast<double>(named.fit.unknowns.size() - base.fit.unknowns.size());
    handicap.push_back(0.5 * more * std::log(static_cast<double>(all.cols())) +
                       std::log(static_cast<double>(candidates_.size())));
  }
  const std::vector<double> probability =
      model_probabilities(all, handicap, seed_, test_judge_.options());
  list.none = probability[0];
  for (std::size_t i = 0; i < list.entries.size(); ++i) {
    FittedCandidate& named = list.entries[i];
    const auto row = static_cast<Eigen::Index>(i + 1);
    named.evidence = (on_test.row(row) - on_test.row(0)).sum();
    named.significance =
        block_significance((all.row(row) - all.row(0)).transpose(), test_judge_.options());
    named.probability = probability[i + 1];
  }
  std::stable_sort(list.entries.begin(), list.entries.end(),
                   [](const FittedCandidate& a, const FittedCandidate& b) {
                     return a.probability > b.probability;
                   });
}

void CandidateComparison::follow(const Tested& base, ShortList& list) const {
  train_.side_by_side(list.entries.size(), [&](std::size_t i) {
    FittedCandidate& named = list.entries[i];
    try {
      FittedCandidate other = fit(base.fit, named.candidate, named.fit.variant.effects.back());
      train_.improve(other.fit, options_.comparison.iterations, least_gain(other.fit));
      if (other.fit.cost >= named.fit.cost) return;
      other.test = test_.residual(other.fit.variant);
      if (other.test.size() > 0) named = std::move(other);
    } catch (const NotSimulated&) {
      // Stays where it is.
    }
  });
  judge(base, list);
  prefer_simpler(base.fit, list);
}

void CandidateComparison::turn_to_better_phase(const Fitted& base, FittedCandidate& named) const {
  if (!has_phase(candidates_[named.candidate])) return;
  const auto turned = better_phase(train_, candidates_[named.candidate], named.fit);
  if (!turned) return;
  try {
    FittedCandidate other = fit(base, named.candidate, *turned);
    train_.improve(other.fit, options_.comparison.iterations, least_gain(other.fit));
    if (other.fit.cost < named.fit.cost) named = std::move(other);
  } catch (const NotSimulated&) {
    // Stays where it is.
  }
}

void CandidateComparison::prefer_simpler(const Fitted& base, ShortList& list) const {
  if (list.entries.empty()) return;
  const FittedCandidate& best = list.entries.front();
  const Candidate& whole = candidates_[best.candidate];
  for (std::size_t i = 1; i < list.entries.size(); ++i) {
    const FittedCandidate& other = list.entries[i];
    const double share = share_of_simpler(candidates_[other.candidate], whole, options_.comparison);
    const double gain = base.cost - other.fit.cost;
    if (share == 1.0 || gain < share * (base.cost - best.fit.cost) || other.evidence <= 0.0) {
      continue;
    }
    FittedCandidate simple = std::move(list.entries[i]);
    simple.probability += best.probability;
    list.entries.front().probability = 0.0;
    list.entries.erase(list.entries.begin() + static_cast<std::ptrdiff_t>(i));
    list.entries.insert(list.entries.begin(), std::move(simple));
    return;
  }
}

ShortList CandidateComparison::weigh(const Tested& base, const std::vector<Score>& scores) const {
  const std::vector<Score> tried =
      Trials(scan_, candidates_, options_.trials).best(base.fit, scores);
  std::vector<std::optional<FittedCandidate>> fitted(tried.size());
  train_.side_by_side(tried.size(), [&](std::size_t i) {
    try {
      const std::size_t candidate = tried[i].candidate;
      fitted[i] = fit(base.fit, candidate, candidates_[candidate].sized(tried[i].amount));
    } catch (const NotSimulated&) {
      // Cannot be simulated at that size: not this one.
    }
  });
  ShortList list;
  for (std::optional<FittedCandidate>& named : fitted) {
    if (named) list.entries.push_back(std::move(*named));
  }
  std::stable_sort(
      list.entries.begin(), list.entries.end(),
      [](const FittedCandidate& a, const FittedCandidate& b) { return a.fit.cost < b.fit.cost; });
  if (list.entries.size() > options_.comparison.judged)
    list.entries.resize(options_.comparison.judged);
  const auto fit_on = [&](FittedCandidate& named, double rival) {
    train_.improve(named.fit, options_.comparison.iterations, least_gain(named.fit), rival);
    turn_to_better_phase(base.fit, named);
    named.test = test_.residual(named.fit.variant);
  };
  if (!list.entries.empty()) {
    fit_on(list.entries.front(), HUGE_VAL);
    const double first = list.entries.front().fit.cost;
    train_.side_by_side(list.entries.size() - 1,
                        [&](std::size_t i) { fit_on(list.entries[i + 1], first); });
  }
  list.entries.erase(
      std::remove_if(list.entries.begin(), list.entries.end(),
                     [](const FittedCandidate& named) { return named.test.size() == 0; }),
      list.entries.end());
  judge(base, list);
  prefer_simpler(base.fit, list);
  return list;
}

}  // namespace discovery
}  // namespace anthrob
