#include "detectability/detectability.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "anthrob_sim/effects/placed_effects.h"
#include "fit/likelihood_profile.h"
#include "judgement/merit.h"
#include "judgement/quantiles.h"

namespace anthrob {
namespace discovery {

namespace {

/// Gap at which each channel is mostly above `faint_gap` [floors].
/// @param mostly standard deviations
std::map<std::string, double> mostly_looked_at(const Judge& train, const Judge& test,
                                               double mostly) {
  const auto learned = train.chance_of_gaps();
  std::map<std::string, double> levels;
  for (const auto& [name, held_out] : test.chance_of_gaps()) {
    const auto found = learned.find(name);
    if (found == learned.end()) continue;
    levels[name] = train.options().faint_gap * (1.0 + mostly * std::max(held_out, found->second));
  }
  return levels;
}

/// Evidence E scatters by sqrt(2 E).
/// @return expected evidence that is mostly enough [nat]
double mostly_enough(double evidence, double mostly) {
  const double root = mostly / std::sqrt(2.0) + std::sqrt(0.5 * mostly * mostly + evidence);
  return root * root;
}

/// Finds the smallest size of each candidate.
class Finder {
 public:
  Finder(const Hypotheses& hypotheses, const Fitted& base)
      : candidates_(hypotheses.candidates),
        fit_(hypotheses.scan),
        base_(base),
        train_(hypotheses.train_judge),
        test_(hypotheses.test_judge),
        options_(hypotheses.options.detectability),
        mostly_(one_sided_deviations(options_.probability)),
        held_out_(total_duration(hypotheses.test.experiments())) {}

  Detectability find(const Screening& screening, std::vector<Score> scores) const;

 private:
  double doses_for_evidence(const Score& score) const;
  /// Checks turns of the world or of the observer by fitting, because ordinary parameters of all
  /// muscles together imitate them, and not linearly.
  void check_turns(const std::vector<Score>& scores, std::vector<double>& doses) const;
  /// Increases a number of doses until nine tenths of the predicted evidence are left. @return that
  /// number; infinite if it cannot be simulated or nothing is left
  double checked(const LikelihoodProfile& profile, const Score& score, double doses) const;
  Visibility visibility_of(const Score& score, double doses) const;
  /// Whether a size so far from neutral is realistic, and within its bounds.
  bool is_met(const Score& score, double doses) const;
  double taken_for_ordinary(const Candidate& candidate) const;

  const std::vector<Candidate>& candidates_;
  const ModelFit& fit_;
  const Fitted& base_;
  const Judge &train_, &test_;
  const DetectabilityOptions& options_;
  double mostly_;    ///< standard deviations below which a number is with that probability
  double held_out_;  ///< length of the held-out recordings [s]
};

Detectability Finder::find(const Screening& screening, std::vector<Score> scores) const {
  std::sort(scores.begin(), scores.end(),
            [](const Score& a, const Score& b) { return a.candidate < b.candidate; });
  std::vector<double> doses =
      screening.doses_to_a_gap(base_, scores, train_, mostly_looked_at(train_, test_, mostly_));
  for (std::size_t s = 0; s < scores.size(); ++s) {
    doses[s] = std::max(doses[s], doses_for_evidence(scores[s]));
  }
  check_turns(scores, doses);
  Detectability found;
  std::vector<Visibility> all;
  for (std::size_t s = 0; s < scores.size(); ++s) {
    all.push_back(visibility_of(scores[s], doses[s]));
    (is_met(scores[s], doses[s]) ? found.visible : found.not_visible).push_back(all.back());
  }
  for (const auto& group : screening.alike(base_)) {
    found.alike.emplace_back();
    for (const std::size_t candidate : group) found.alike.back().push_back(all[candidate]);
  }
  return found;
}

double Finder::doses_for_evidence(const Score& score) const {
  const double evidence =
      mostly_enough(needed_evidence(candidates_.size(), train_.options().merit), mostly_);
  return score.uncertainty * std::sqrt(2.0 * evidence * score.seconds / held_out_);
}

void Finder::check_turns(const std::vector<Score>& scores, std::vector<double>& doses) const {
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

double Finder::checked(const LikelihoodProfile& profile, const Score& score, double doses) const {
  const double deviations = doses / score.uncertainty;
  const double needed =
      0.5 * deviations * deviations * total_duration(fit_.experiments()) / score.seconds;
  for (int round = 0; round < options_.rounds && is_met(score, doses); ++round) {
    const auto rise = profile.rise(candidates_[score.candidate], score.size, doses, needed);
    if (!rise || *rise <= 0.0) return HUGE_VAL;
    if (*rise > options_.enough * needed) return doses;
    doses *= std::sqrt(needed / *rise);
  }
  return doses;
}

Visibility Finder::visibility_of(const Score& score, double doses) const {
  const Candidate& candidate = candidates_[score.candidate];
  const EffectParameter& size = *candidate.sizes()[score.size];
  return {candidate.effect->info().id, candidate.place, size.unit,
          doses * std::abs(size.typical - size.neutral) + taken_for_ordinary(candidate)};
}

bool Finder::is_met(const Score& score, double doses) const {
  const Candidate& candidate = candidates_[score.candidate];
  const EffectParameter& size = *candidate.sizes()[score.size];
  const double largest = std::max(size.bounds.hi - size.neutral, size.neutral - size.bounds.lo);
  const double most = std::max(options_.most_doses, candidate.realistic_doses);
  return doses <= most && visibility_of(score, doses).smallest_visible <= largest;
}

/// How much of an effect may be taken for an ordinary parameter that is the same quantity.
double Finder::taken_for_ordinary(const Candidate& candidate) const {
  const EffectParameter& size = *candidate.sizes().front();
  const bool either = size.bounds.lo < size.neutral;
  double room = 0.0;
  for (const Unknown& u : base_.unknowns) {
    if (!std::count(candidate.same_as.begin(), candidate.same_as.end(), u.nuisance)) continue;
    room = std::max({room, u.upper - u.expected, either ? u.expected - u.lower : 0.0});
  }
  return room;
}

}  // namespace

Detectability detect(const Hypotheses& hypotheses, const Fitted& base, const Screening& screening,
                     std::vector<Score> scores) {
  return Finder(hypotheses, base).find(screening, std::move(scores));
}

}  // namespace discovery
}  // namespace anthrob
