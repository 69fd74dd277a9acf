#include "anthrob_calib/discovery/run_off.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "anthrob_calib/discovery/merit.h"

namespace anthrob {
namespace discovery {

namespace {

constexpr double kComesNear = 0.5;   ///< share of the first one's gain
constexpr double kLagsBehind = 0.4;  ///< lacking that after rough steps is lost

}  // namespace

std::size_t RunOff::challenger(const Tested& base, const ShortList& list) const {
  const Named& first = list.named.front();
  const Candidate& its = bench_.candidates[first.candidate];
  std::size_t best = 0;
  double least = base.fit.cost - kComesNear * (base.fit.cost - first.fit.cost);
  for (std::size_t i = 1; i < list.named.size(); ++i) {
    const Candidate& other = bench_.candidates[list.named[i].candidate];
    // A law that says more at the same place is for the next round.
    if (other.effect == its.effect || says_less(its, other)) continue;
    if (list.named[i].fit.cost >= least) continue;
    least = list.named[i].fit.cost;
    best = i;
  }
  return best;
}

bool RunOff::finish(Named& named, double level) const {
  std::optional<Fitted> end = bench_.settling.to_the_end_within_reach(named.fit, level);
  if (!end) return false;
  Tested tested = bench_.tested(std::move(*end));
  if (tested.test.size() > 0) static_cast<Tested&>(named) = std::move(tested);
  return true;
}

void RunOff::decide(const Tested& base, ShortList& list) const {
  const std::size_t index = challenger(base, list);
  ShortList end;
  end.named = {list.named.front()};
  finish(end.named[0], HUGE_VAL);
  if (index > 0) {
    const double least = end.named[0].fit.cost;
    Named other = list.named[index];
    if (finish(other, least + kLagsBehind * (base.fit.cost - least))) {
      end.named.push_back(std::move(other));
    }
  }
  bench_.naming.judge(base, end);
  const double first_probability = list.named.front().probability;
  const bool kept = end.named[0].candidate == list.named.front().candidate;
  if (kept || !lack(gaps_.merit_of(end, base)).empty()) {
    Named& first = kept ? end.named[0] : end.named[1];
    first.probability = first_probability;
    list.named.front() = std::move(first);
    return;
  }
  const Effect* beaten = bench_.candidates[list.named.front().candidate].effect;
  const double share =
      end.named[0].probability / (end.named[0].probability + end.named[1].probability);
  Named winner = std::move(end.named[0]);
  winner.probability = list.named[index].probability;
  list.named.front() = std::move(end.named[1]);
  list.named.front().probability = first_probability;
  for (Named& named : list.named) {
    if (bench_.candidates[named.candidate].effect != beaten) continue;
    winner.probability += share * named.probability;
    named.probability *= 1.0 - share;
  }
  list.named.erase(list.named.begin() + static_cast<std::ptrdiff_t>(index));
  list.named.insert(list.named.begin(), std::move(winner));
  std::stable_sort(list.named.begin() + 1, list.named.end(),
                   [](const Named& a, const Named& b) { return a.probability > b.probability; });
}

}  // namespace discovery
}  // namespace anthrob
