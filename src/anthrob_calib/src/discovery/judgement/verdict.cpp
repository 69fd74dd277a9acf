#include "anthrob_calib/discovery/judgement/verdict.h"

#include <algorithm>

#include "anthrob_calib/discovery/judgement/criteria.h"

namespace anthrob {
namespace discovery {

namespace {

constexpr double kMostRemains = 0.45;  ///< largest share of the squared gap left by an answer

/// Whether the channel of a dependence has a gap larger than a wrong noise estimate may cause.
bool is_real(const Dependence& dependence, const std::map<std::string, double>& left) {
  return std::any_of(left.begin(), left.end(), [&](const auto& channel) {
    return dependence.channel.rfind(channel.first, 0) == 0 && channel.second > kRealGap;
  });
}

/// How much of the squared gap a dependence explains. A gap that depends on nothing is
/// underestimated noise, not a missing effect.
double explained(const Dependence& dependence, const std::map<std::string, double>& left) {
  const double share = std::max(dependence.predicted(), dependence.constant);
  double most = 0.0;
  for (const auto& [name, gap] : left) {
    if (dependence.channel.rfind(name, 0) != 0 || share < Dependence::kTelling) continue;
    most = std::max(most, share * excess(gap, kRealGap));
  }
  return most;
}

}  // namespace

double trust_in(const FoundEffect& effect, bool left_counts) {
  const double of_shape = effect.at_limit.empty() ? 1.0 : kAtLimit;
  const double of_channels = kEvenOddsSpoilt / (kEvenOddsSpoilt + effect.spoilt);
  const double of_left = left_counts ? kEvenOdds / (kEvenOdds + effect.left) : 1.0;
  return of_shape * of_channels * of_left;
}

void fill_in_verdict(const std::map<std::string, double>& left, bool certain, Answer& answer) {
  answer.certain = certain;
  if (answer.effects.empty()) {
    const bool any = certain || !answer.one_sided.empty();
    answer.verdict = any ? "unexplained" : "no_missing_effect";
  } else {
    const bool most_remains = certain && answer.remaining_share > kMostRemains;
    answer.verdict = most_remains ? "unexplained" : "effects_found";
    // What is left suggests that the true law is another one.
    for (FoundEffect& effect : answer.effects) {
      const double trust = trust_in(effect);
      effect.probability *= trust;
      for (Rival& rival : effect.rivals) rival.probability *= trust;
    }
  }
  auto& remaining = answer.remaining;
  remaining.erase(
      std::remove_if(remaining.begin(), remaining.end(),
                     [&](const Dependence& d) { return !certain || !is_real(d, left); }),
      remaining.end());
  std::stable_sort(remaining.begin(), remaining.end(),
                   [&](const Dependence& a, const Dependence& b) {
                     return explained(a, left) > explained(b, left);
                   });
  const bool any = !remaining.empty() && explained(remaining.front(), left) > 0.0;
  const Dependence* cause = any ? &remaining.front() : nullptr;
  if (!certain && !answer.one_sided.empty()) {
    answer.remaining_description = answer.one_sided.front().channel +
                                   " differs between the fitted and the held-out recordings";
  } else if (!certain) {
    answer.remaining_description = "no certain gap";
  } else if (cause && cause->constant > cause->predicted()) {
    answer.remaining_description = cause->channel + " is off by a constant";
  } else if (cause) {
    answer.remaining_description = cause->channel + " depends on " + cause->on_what();
  } else {
    answer.remaining_description = "a gap that depends on none of the measured quantities";
  }
}

}  // namespace discovery
}  // namespace anthrob
