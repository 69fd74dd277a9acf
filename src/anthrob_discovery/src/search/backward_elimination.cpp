#include "search/backward_elimination.h"

#include "judgement/merit.h"

namespace anthrob {
namespace discovery {

std::optional<Tested> BackwardElimination::without(std::size_t effect, std::size_t candidate,
                                                   double gained, const Tested& with) const {
  std::optional<Fitted> reduced = hypotheses_.without(effect, candidate, with.fit);
  const double reach = with.fit.cost + hypotheses_.options.search.out_of_reach * gained;
  if (!reduced || !hypotheses_.convergence.converge_within_reach(*reduced, reach))
    return std::nullopt;
  Tested base = hypotheses_.tested(hypotheses_.convergence.to_the_end(*reduced));
  if (base.test.size() == 0) return std::nullopt;
  ShortList list;
  list.entries.resize(1);
  static_cast<Tested&>(list.entries[0]) = with;
  list.entries[0].candidate = candidate;
  hypotheses_.comparison.judge(base, list);
  if (!lack(gaps_.merit_of(list, base), hypotheses_.options.judgement.merit)) return std::nullopt;
  return base;
}

}  // namespace discovery
}  // namespace anthrob
