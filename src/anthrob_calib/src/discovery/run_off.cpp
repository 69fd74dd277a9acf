#include "anthrob_calib/discovery/run_off.h"

#include <algorithm>

namespace anthrob {
namespace discovery {

namespace {

constexpr double kComesNear = 0.5;  ///< share of the first one's gain

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

void RunOff::finish(Named& named) const {
  Tested tested = bench_.tested(bench_.settling.to_the_end(named.fit));
  if (tested.test.size() > 0) static_cast<Tested&>(named) = std::move(tested);
}

void RunOff::decide(const Tested& base, ShortList& list) const {
  const std::size_t index = challenger(base, list);
  finish(list.named.front());
  if (index == 0) return;
  ShortList two;
  two.named = {list.named.front(), list.named[index]};
  finish(two.named[1]);
  const std::size_t other = two.named[1].candidate;
  bench_.naming.judge(base, two);
  if (two.named[0].candidate != other) return;
  const Effect* beaten = bench_.candidates[list.named.front().candidate].effect;
  const double share =
      two.named[0].probability / (two.named[0].probability + two.named[1].probability);
  Named winner = std::move(two.named[0]);
  winner.probability = list.named[index].probability;
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
