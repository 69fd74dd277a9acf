#include "anthrob_calib/discovery/run_off.h"

#include <algorithm>
#include <cmath>

#include "anthrob_calib/discovery/merit.h"
#include "anthrob_calib/discovery/scatter.h"

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

/// Of what two laws have together, that of the better one.
double RunOff::share_of_better(const Tested& base, const ShortList& end) const {
  if (end.named.size() == 1) return 1.0;
  const Named &better = end.named[0], &other = end.named[1];
  const double by_blocks = better.probability / (better.probability + other.probability);
  return allowing_for_scatter(by_blocks, bench_.settling, base, better, other);
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
  const bool kept = end.named[0].candidate == list.named.front().candidate;
  if (index == 0 || (!kept && !lack(gaps_.merit_of(end, base)).empty())) {
    Named& first = kept ? end.named[0] : end.named[1];
    first.probability = list.named.front().probability;
    list.named.front() = std::move(first);
    return;
  }
  const std::size_t better = kept ? 0 : index, worse = kept ? index : 0;
  const Candidate& winner = bench_.candidates[list.named[better].candidate];
  const Effect* beaten = bench_.candidates[list.named[worse].candidate].effect;
  double both = list.named[better].probability;
  for (std::size_t i = worse; i < list.named.size(); ++i) {
    const Candidate& place = bench_.candidates[list.named[i].candidate];
    if (place.effect != beaten || (i != worse && says_less(winner, place))) continue;
    both += list.named[i].probability;
    list.named[i].probability = 0.0;
  }
  const double share = share_of_better(base, end);
  if (end.named.size() > 1) {
    end.named[1].probability = (1.0 - share) * both;
    list.named[worse] = std::move(end.named[1]);
  }
  end.named[0].probability = share * both;
  list.named.erase(list.named.begin() + static_cast<std::ptrdiff_t>(better));
  list.named.insert(list.named.begin(), std::move(end.named[0]));
  std::stable_sort(list.named.begin() + 1, list.named.end(),
                   [](const Named& a, const Named& b) { return a.probability > b.probability; });
}

}  // namespace discovery
}  // namespace anthrob
