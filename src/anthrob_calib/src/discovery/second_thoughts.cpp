#include "anthrob_calib/discovery/second_thoughts.h"

#include "anthrob_calib/discovery/criteria.h"
#include "anthrob_calib/discovery/reduction.h"

namespace anthrob {
namespace discovery {

std::optional<Tested> SecondThoughts::without(std::size_t effect, std::size_t candidate,
                                              double gained, const Tested& with) const {
  std::optional<Fitted> reduced =
      without_effect(evaluator_, train_, with.fit, effect, candidates_[candidate]);
  if (!reduced || !settling_.settle_within_reach(*reduced, with.fit.cost + kOutOfReach * gained)) {
    return std::nullopt;
  }
  Tested base;
  base.fit = settling_.to_the_end(*reduced);
  base.test = test_.residual(base.fit.variant);
  if (base.test.size() == 0) return std::nullopt;
  ShortList list;
  list.named.resize(1);
  static_cast<Tested&>(list.named[0]) = with;
  list.named[0].candidate = candidate;
  naming_.judge(base, list);
  if (lack(gaps_.merit_of(list, base)).empty()) return std::nullopt;
  return base;
}

}  // namespace discovery
}  // namespace anthrob
