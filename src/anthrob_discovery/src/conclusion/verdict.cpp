#include "conclusion/verdict.h"

#include <algorithm>

#include "judgement/excess.h"

namespace anthrob {
namespace discovery {

namespace {

/// Whether the channel of a dependence has a gap larger than a wrong noise estimate may cause.
bool is_real(const Dependence& dependence, const std::map<std::string, double>& left,
             const Options& options) {
  return std::any_of(left.begin(), left.end(), [&](const auto& channel) {
    return dependence.channel.rfind(channel.first, 0) == 0 &&
           channel.second > options.judgement.real_gap;
  });
}

/// How much of the squared gap a dependence explains. A gap that depends on nothing is
/// underestimated noise, not a missing effect.
double explained(const Dependence& dependence, const std::map<std::string, double>& left,
                 const Options& options) {
  const double share = std::max(dependence.predicted(), dependence.constant);
  double most = 0.0;
  for (const auto& [name, gap] : left) {
    if (dependence.channel.rfind(name, 0) != 0 || share < options.diagnosis.dependence.telling)
      continue;
    most = std::max(most, share * excess(gap, options.judgement.real_gap));
  }
  return most;
}

}  // namespace

std::string verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNoMissingEffect:
      return "no_missing_effect";
    case Verdict::kEffectsFound:
      return "effects_found";
    case Verdict::kUnexplained:
      return "unexplained";
    case Verdict::kCannotTell:
      return "cannot_tell";
  }
  return {};
}

Verdict verdict_on(bool any_effect, const Diagnosis& diagnosis, const ConclusionOptions& options) {
  if (!any_effect) {
    const bool any = diagnosis.certain || !diagnosis.one_sided.empty();
    return any ? Verdict::kUnexplained : Verdict::kNoMissingEffect;
  }
  const bool most_remains = diagnosis.certain && diagnosis.remaining_share > options.most_remains;
  return most_remains ? Verdict::kUnexplained : Verdict::kEffectsFound;
}

FoundEffect trusted(FoundEffect effect, const TrustOptions& options) {
  const double trust = trust_in(effect, options);
  effect.probability *= trust;
  for (Rival& rival : effect.rivals) rival.probability *= trust;
  return effect;
}

Remaining remaining_of(const Diagnosis& diagnosis, const Options& options) {
  const auto& left = diagnosis.learned;
  Remaining rest;
  rest.share = diagnosis.remaining_share;
  rest.certain = diagnosis.certain;
  if (rest.certain) {
    std::copy_if(diagnosis.remaining.begin(), diagnosis.remaining.end(),
                 std::back_inserter(rest.dependences),
                 [&](const Dependence& d) { return is_real(d, left, options); });
  }
  std::stable_sort(rest.dependences.begin(), rest.dependences.end(),
                   [&](const Dependence& a, const Dependence& b) {
                     return explained(a, left, options) > explained(b, left, options);
                   });
  const bool any =
      !rest.dependences.empty() && explained(rest.dependences.front(), left, options) > 0.0;
  const Dependence* cause = any ? &rest.dependences.front() : nullptr;
  if (!rest.certain && !diagnosis.one_sided.empty()) {
    rest.description = diagnosis.one_sided.front().channel +
                       " differs between the fitted and the held-out recordings";
  } else if (!rest.certain) {
    rest.description = "no certain gap";
  } else if (cause && cause->constant > cause->predicted()) {
    rest.description = cause->channel + " is off by a constant";
  } else if (cause) {
    rest.description = cause->channel + " depends on " + cause->on_what();
  } else {
    rest.description = "a gap that depends on none of the measured quantities";
  }
  return rest;
}

}  // namespace discovery
}  // namespace anthrob
