#include "search/final_comparison.h"

#include <algorithm>
#include <cmath>

#include "judgement/merit.h"
#include "search/scatter.h"

namespace anthrob {
namespace discovery {

namespace {}  // namespace

bool FinalComparison::may_challenge(const Candidate& other, const Candidate& first,
                                    Challenger kind) const {
  // A law that says more at the same place is for the next round.
  if (kind == Challenger::kOtherLaw) {
    return other.effect != first.effect && !is_nested_in(first, other);
  }
  // One law for all places is for unite() (CommonLaw).
  return other.effect == first.effect && other.owner() != first.owner() && !other.is_everywhere() &&
         !first.is_everywhere();
}

std::size_t FinalComparison::challenger(Challenger kind, double level,
                                        const ShortList& list) const {
  const FittedCandidate& first = list.entries.front();
  std::size_t best = 0;
  double least = level;
  for (std::size_t i = 1; i < list.entries.size(); ++i) {
    if (!may_challenge(hypotheses_.candidates[list.entries[i].candidate],
                       hypotheses_.candidates[first.candidate], kind)) {
      continue;
    }
    if (list.entries[i].fit.cost >= least) continue;
    least = list.entries[i].fit.cost;
    best = i;
  }
  return best;
}

bool FinalComparison::finish(FittedCandidate& named, double level, double rival) const {
  std::optional<Fitted> end =
      hypotheses_.convergence.to_the_end_within_reach(named.fit, level, rival);
  if (!end) return false;
  Tested tested = hypotheses_.tested(std::move(*end));
  if (tested.test.size() > 0) static_cast<Tested&>(named) = std::move(tested);
  return true;
}

/// The better law's share of the probability of both.
double FinalComparison::share_of_better(const Tested& base, const ShortList& end) const {
  if (end.entries.size() == 1) return 1.0;
  const FittedCandidate &better = end.entries[0], &other = end.entries[1];
  const double by_blocks = better.probability / (better.probability + other.probability);
  return allowing_for_scatter(by_blocks, hypotheses_.convergence, base, better, other,
                              hypotheses_.options.search.scatter);
}

void FinalComparison::decide(const Tested& base, ShortList& list) const {
  FittedCandidate& first = list.entries.front();
  const double level = base.fit.cost - options().comes_near * (base.fit.cost - first.fit.cost);
  finish(first, HUGE_VAL, HUGE_VAL);
  compare(base, Challenger::kOtherLaw, level, list);
  compare(base, Challenger::kOtherPlace, level, list);
}

void FinalComparison::compare(const Tested& base, Challenger kind, double level,
                              ShortList& list) const {
  const std::size_t index = challenger(kind, level, list);
  if (kind == Challenger::kOtherPlace && index == 0) return;
  ShortList end;
  end.entries = {list.entries.front()};
  if (index > 0) {
    const double least = end.entries[0].fit.cost;
    FittedCandidate other = list.entries[index];
    // At another place, a law may need more than rough steps to find its parameters.
    const double gain = base.fit.cost - least;
    const double reach =
        kind == Challenger::kOtherLaw
            ? least + std::min(options().lags_behind * gain,
                               std::max(options().far_above * least, options().behind * gain))
            : HUGE_VAL;
    if (finish(other, reach, least)) {
      end.entries.push_back(std::move(other));
    }
  }
  hypotheses_.comparison.judge(base, end);
  const bool kept = end.entries[0].candidate == list.entries.front().candidate;
  if (index == 0 ||
      (!kept && lack(gaps_.merit_of(end, base), hypotheses_.options.judgement.merit))) {
    FittedCandidate& first = kept ? end.entries[0] : end.entries[1];
    first.probability = list.entries.front().probability;
    list.entries.front() = std::move(first);
    return;
  }
  const std::size_t better = kept ? 0 : index, worse = kept ? index : 0;
  const Candidate& winner = hypotheses_.candidates[list.entries[better].candidate];
  const Effect* beaten = hypotheses_.candidates[list.entries[worse].candidate].effect;
  double both = list.entries[better].probability;
  for (std::size_t i = worse; i < list.entries.size(); ++i) {
    const Candidate& place = hypotheses_.candidates[list.entries[i].candidate];
    const bool other_place =
        kind == Challenger::kOtherLaw && place.effect == beaten && !is_nested_in(winner, place);
    if (i != worse && !other_place) continue;
    both += list.entries[i].probability;
    list.entries[i].probability = 0.0;
  }
  const double share = share_of_better(base, end);
  if (end.entries.size() > 1) {
    end.entries[1].probability = (1.0 - share) * both;
    list.entries[worse] = std::move(end.entries[1]);
  }
  end.entries[0].probability = share * both;
  list.entries.erase(list.entries.begin() + static_cast<std::ptrdiff_t>(better));
  list.entries.insert(list.entries.begin(), std::move(end.entries[0]));
  std::stable_sort(list.entries.begin() + 1, list.entries.end(),
                   [](const FittedCandidate& a, const FittedCandidate& b) {
                     return a.probability > b.probability;
                   });
}

}  // namespace discovery
}  // namespace anthrob
