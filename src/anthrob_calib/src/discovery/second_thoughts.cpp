#include "anthrob_calib/discovery/second_thoughts.h"

#include "anthrob_calib/discovery/criteria.h"

namespace anthrob {
namespace discovery {

std::optional<Tested> SecondThoughts::without(std::size_t effect, std::size_t candidate,
                                              double gained, const Tested& with) const {
  std::optional<Fitted> reduced = bench_.without(effect, candidate, with.fit);
  const double reach = with.fit.cost + kOutOfReach * gained;
  if (!reduced || !bench_.settling.settle_within_reach(*reduced, reach)) return std::nullopt;
  Tested base = bench_.tested(bench_.settling.to_the_end(*reduced));
  if (base.test.size() == 0) return std::nullopt;
  ShortList list;
  list.named.resize(1);
  static_cast<Tested&>(list.named[0]) = with;
  list.named[0].candidate = candidate;
  bench_.naming.judge(base, list);
  if (lack(gaps_.merit_of(list, base)).empty()) return std::nullopt;
  return base;
}

}  // namespace discovery
}  // namespace anthrob
