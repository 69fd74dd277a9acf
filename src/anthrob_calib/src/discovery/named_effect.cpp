#include "anthrob_calib/discovery/named_effect.h"

#include <algorithm>
#include <cmath>

#include "anthrob_calib/discovery/criteria.h"
#include "anthrob_calib/discovery/verdict.h"

namespace anthrob {
namespace discovery {

void note_what_it_shows_in(const Judge& judge, const Eigen::VectorXf& without,
                           const Eigen::VectorXf& with, NamedEffect& effect) {
  const auto after = judge.channel_gaps(with);
  double most = 0.0;
  for (const auto& [name, gap] : judge.channel_gaps(without)) {
    const double before = excess(gap, kFaintGap);
    const double taken = before - excess(after.at(name), kFaintGap);
    if (taken <= most) continue;
    most = taken;
    effect.found.shows_in = name;
    effect.before = before;
  }
}

void measure_what_is_left(const Judge& judge, const Eigen::VectorXf& first,
                          const Eigen::VectorXf& left, std::vector<NamedEffect>& effects) {
  const auto at_first = judge.channel_gaps(first), after = judge.channel_gaps(left);
  for (NamedEffect& effect : effects) {
    const std::string& channel = effect.found.shows_in;
    effect.found.left = 1.0;
    if (channel.empty()) continue;
    const double whole = std::max(effect.before, excess(at_first.at(channel), kFaintGap));
    if (whole > 0.0) effect.found.left = excess(after.at(channel), kFaintGap) / whole;
  }
}

std::string limit_of(const Candidate& candidate, const EffectInstance& instance) {
  for (const EffectParameter& p : candidate.parameters) {
    const double range = p.bounds.hi - p.bounds.lo;
    const bool either_way = p.bounds.lo < 0.0 && p.bounds.hi > 0.0 && std::isfinite(range);
    if (p.kind != EffectParameter::kShape || !either_way) continue;
    const double value = instance.parameters.at(p.name);
    if (std::min(value - p.bounds.lo, p.bounds.hi - value) < kNearLimit * range) return p.name;
  }
  return "";
}

const NamedEffect* least_of_improbable(const std::vector<NamedEffect>& effects) {
  const NamedEffect* least = nullptr;
  for (const NamedEffect& effect : effects) {
    double together = effect.found.probability;
    for (const Rival& rival : effect.found.rivals) together += rival.probability;
    if (together * trust_in(effect.found) >= kImprobable) continue;
    if (!least || effect.gained < least->gained) least = &effect;
  }
  return least;
}

}  // namespace discovery
}  // namespace anthrob
