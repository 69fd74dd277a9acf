#include "search/named_effect.h"

#include <algorithm>
#include <cmath>

#include "judgement/excess.h"

namespace anthrob {
namespace discovery {

void note_what_it_changes(const Judge& judge, const Eigen::VectorXf& without,
                          const Eigen::VectorXf& with, NamedEffect& effect) {
  const auto after = judge.channel_gaps(with);
  effect.raised.clear();
  effect.lowered = 0.0;
  double most = 0.0;
  for (const auto& [name, gap] : judge.channel_gaps(without)) {
    const double more = excess(after.at(name), gap);
    if (more > 0.0) effect.raised[name] = more;
    effect.lowered += excess(gap, after.at(name));
    const double before = excess(gap, judge.options().faint_gap);
    const double taken = before - excess(after.at(name), judge.options().faint_gap);
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
    const double whole =
        std::max(effect.before, excess(at_first.at(channel), judge.options().faint_gap));
    if (whole > 0.0)
      effect.found.left = excess(after.at(channel), judge.options().faint_gap) / whole;
  }
}

std::optional<std::string> limit_of(const Candidate& candidate, const EffectInstance& instance,
                                    const TrustOptions& options) {
  for (const EffectParameter& p : candidate.parameters) {
    const double range = p.bounds.hi - p.bounds.lo;
    const bool either_way = p.bounds.lo < 0.0 && p.bounds.hi > 0.0 && std::isfinite(range);
    if (p.kind != EffectParameter::kShape || !either_way) continue;
    const double value = instance.parameters.at(p.name);
    if (std::min(value - p.bounds.lo, p.bounds.hi - value) < options.near_limit * range)
      return p.name;
  }
  return std::nullopt;
}

bool charge_spoilt_channels(const Judge& judge, const Eigen::VectorXf& first,
                            const Eigen::VectorXf& left, std::vector<NamedEffect>& effects) {
  const auto at_first = judge.channel_gaps(first);
  std::vector<double> worst(effects.size(), 0.0);
  for (NamedEffect& effect : effects) {
    effect.found.spoils.clear();
    effect.found.spoilt = 0.0;
  }
  for (const auto& [name, gap] : judge.channel_gaps(left)) {
    const double allowed = std::max(1.0, at_first.at(name));
    const double spoilt = gap / (judge.options().trust.spoilt * allowed);
    if (spoilt <= 1.0) continue;
    std::size_t charged = effects.size();
    double most = 0.0;
    for (std::size_t e = 0; e < effects.size(); ++e) {
      const auto raised = effects[e].raised.find(name);
      if (raised == effects[e].raised.end() || raised->second <= most) continue;
      most = raised->second;
      charged = e;
    }
    if (charged == effects.size()) continue;
    NamedLaw& found = effects[charged].found;
    found.spoilt += excess(gap, allowed) / effects[charged].lowered;
    if (spoilt <= worst[charged]) continue;
    worst[charged] = spoilt;
    found.spoils = name;
  }
  return std::any_of(worst.begin(), worst.end(), [](double w) { return w > 0.0; });
}

const NamedEffect* least_of_improbable(const std::vector<NamedEffect>& effects, bool left_counts,
                                       const TrustOptions& options) {
  const NamedEffect* least = nullptr;
  for (const NamedEffect& effect : effects) {
    double together = effect.found.probability;
    for (const Rival& rival : effect.found.rivals) together += rival.probability;
    if (together * trust_in(effect.found, options, left_counts) >= options.improbable) continue;
    if (!least || effect.gained < least->gained) least = &effect;
  }
  return least;
}

}  // namespace discovery
}  // namespace anthrob
