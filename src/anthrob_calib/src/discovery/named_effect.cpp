#include "anthrob_calib/discovery/named_effect.h"

#include <algorithm>

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
    if (channel.empty()) continue;
    const double whole = std::max(effect.before, excess(at_first.at(channel), kFaintGap));
    effect.found.left = excess(after.at(channel), kFaintGap) / whole;
  }
}

double likelihood_of(const FoundEffect& effect) {
  double sum = effect.probability;
  for (const Rival& rival : effect.rivals) sum += rival.probability;
  return sum * trust_in(effect);
}

NamedEffect* least_likely(std::vector<NamedEffect>& effects) {
  const auto least = std::min_element(effects.begin(), effects.end(),
                                      [](const NamedEffect& a, const NamedEffect& b) {
                                        return likelihood_of(a.found) < likelihood_of(b.found);
                                      });
  return least == effects.end() ? nullptr : &*least;
}

}  // namespace discovery
}  // namespace anthrob
