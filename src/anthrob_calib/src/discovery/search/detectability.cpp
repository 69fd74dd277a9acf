#include "anthrob_calib/discovery/search/detectability.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "anthrob_calib/discovery/judgement/criteria.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace discovery {

namespace {

constexpr double kMostly = 1.645;   ///< standard deviations: nineteen times out of twenty
constexpr int kRounds = 3;          ///< in which a size is made larger
constexpr double kEnough = 0.9;     ///< of what is needed
constexpr double kMostDoses = 5.0;  ///< [typical sizes] larger ones are unrealistic

/// Gap at which each channel is above kFaintGap nineteen times out of twenty [floors].
std::map<std::string, double> mostly_looked_at(const Judge& train, const Judge& test) {
  const auto learned = train.chance_of_gaps();
  std::map<std::string, double> levels;
  for (const auto& [name, held_out] : test.chance_of_gaps()) {
    const auto found = learned.find(name);
    if (found == learned.end()) continue;
    levels[name] = kFaintGap * (1.0 + kMostly * std::max(held_out, found->second));
  }
  return levels;
}

/// Evidence E scatters by sqrt(2 E).
/// @return expected evidence that is enough nineteen times out of twenty [nat]
double mostly_enough(double evidence) {
  const double root = kMostly / std::sqrt(2.0) + std::sqrt(0.5 * kMostly * kMostly + evidence);
  return root * root;
}

}  // namespace

Detectability::Detectability(const std::vector<Candidate>& candidates, const ModelFit& fit,
                             const Fitted& base, const Judge& train, const Judge& test,
                             double held_out)
    : candidates_(candidates),
      fit_(fit),
      base_(base),
      train_(train),
      test_(test),
      held_out_(held_out) {}

void Detectability::run(const Screening& screening, std::vector<Score> scores,
                        Answer& answer) const {
  std::sort(scores.begin(), scores.end(),
            [](const Score& a, const Score& b) { return a.candidate < b.candidate; });
  std::vector<double> doses =
      screening.doses_to_a_gap(base_, scores, train_, mostly_looked_at(train_, test_));
  for (std::size_t s = 0; s < scores.size(); ++s) {
    doses[s] = std::max(doses[s], doses_for_evidence(scores[s]));
  }
  check_turns(scores, doses);
  std::vector<Visibility> all;
  for (std::size_t s = 0; s < scores.size(); ++s) {
    all.push_back(visibility_of(scores[s], doses[s]));
    (is_met(scores[s], doses[s]) ? answer.visible : answer.not_visible).push_back(all.back());
  }
  for (const auto& group : screening.alike(base_)) {
    answer.alike.emplace_back();
    for (const std::size_t candidate : group) answer.alike.back().push_back(all[candidate]);
  }
}

double Detectability::doses_for_evidence(const Score& score) const {
  const double evidence = mostly_enough(needed_evidence(candidates_.size()));
  return score.uncertainty * std::sqrt(2.0 * evidence * score.seconds / held_out_);
}

void Detectability::check_turns(const std::vector<Score>& scores,
                                std::vector<double>& doses) const {
  std::vector<std::size_t> turns;
  for (std::size_t s = 0; s < scores.size(); ++s) {
    const Effect* effect = candidates_[scores[s].candidate].effect;
    if (dynamic_cast<const WorldAxisEffect*>(effect) == nullptr) continue;
    if (is_met(scores[s], doses[s])) turns.push_back(s);
  }
  if (turns.empty()) return;
  const LikelihoodProfile profile(fit_, base_);
  fit_.side_by_side(turns.size(), [&](std::size_t i) {
    doses[turns[i]] = checked(profile, scores[turns[i]], doses[turns[i]]);
  });
}

double Detectability::checked(const LikelihoodProfile& profile, const Score& score,
                              double doses) const {
  const double deviations = doses / score.uncertainty;
  const double needed =
      0.5 * deviations * deviations * total_duration(fit_.experiments()) / score.seconds;
  for (int round = 0; round < kRounds && is_met(score, doses); ++round) {
    const auto rise = profile.rise(candidates_[score.candidate], score.size, doses, needed);
    if (!rise || *rise <= 0.0) return HUGE_VAL;
    if (*rise > kEnough * needed) return doses;
    doses *= std::sqrt(needed / *rise);
  }
  return doses;
}

Visibility Detectability::visibility_of(const Score& score, double doses) const {
  const Candidate& candidate = candidates_[score.candidate];
  const EffectParameter& size = *candidate.sizes()[score.size];
  return {candidate.effect->info().id, candidate.place, size.unit,
          doses * std::abs(size.typical - size.neutral) + taken_for_ordinary(candidate)};
}

bool Detectability::is_met(const Score& score, double doses) const {
  const Candidate& candidate = candidates_[score.candidate];
  const EffectParameter& size = *candidate.sizes()[score.size];
  const double largest = std::max(size.bounds.hi - size.neutral, size.neutral - size.bounds.lo);
  return doses <= kMostDoses && visibility_of(score, doses).smallest_visible <= largest;
}

/// How much of an effect may be taken for an ordinary parameter that is the same quantity.
double Detectability::taken_for_ordinary(const Candidate& candidate) const {
  const EffectParameter& size = *candidate.sizes().front();
  const bool either = size.bounds.lo < size.neutral;
  double room = 0.0;
  for (const Unknown& u : base_.unknowns) {
    if (!std::count(candidate.same_as.begin(), candidate.same_as.end(), u.nuisance)) continue;
    room = std::max({room, u.upper - u.expected, either ? u.expected - u.lower : 0.0});
  }
  return room;
}

}  // namespace discovery
}  // namespace anthrob
