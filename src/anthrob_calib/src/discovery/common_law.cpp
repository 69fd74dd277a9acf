#include "anthrob_calib/discovery/common_law.h"

#include <algorithm>
#include <utility>

#include "anthrob_calib/discovery/criteria.h"
#include "anthrob_calib/discovery/scatter.h"

namespace anthrob {
namespace discovery {

bool CommonLaw::may_be(std::size_t law, std::size_t one, std::size_t other) const {
  const Candidate& whole = bench_.candidates[law];
  return says_less(bench_.candidates[one], whole) && says_less(bench_.candidates[other], whole);
}

std::optional<CommonLaw::Instead> CommonLaw::instead(std::size_t law, const Tested& with,
                                                     const std::vector<Part>& parts) const {
  std::optional<Fitted> none = with.fit;
  for (auto part = parts.rbegin(); none && part != parts.rend(); ++part) {
    none = bench_.without(part->effect, part->candidate, *none);
  }
  if (!none) return std::nullopt;
  const Tested base = bench_.tested(*none);
  if (base.test.size() == 0) return std::nullopt;
  Score asked;
  asked.candidate = law;
  screening_.renew(base.fit, {asked}, 1);
  const std::vector<Score> scores = screening_.scores(base.fit);
  const auto score = std::find_if(scores.begin(), scores.end(),
                                  [&](const Score& s) { return s.candidate == law; });
  if (score == scores.end()) return std::nullopt;
  const ShortList list = bench_.naming.weigh(base, {*score});
  if (list.named.empty()) return std::nullopt;
  const Fitted& rough = list.named.front().fit;
  const double gained = base.fit.cost - with.fit.cost;
  if (rough.cost - with.fit.cost > kOutOfReach * gained) return std::nullopt;
  Tested alone = bench_.tested(bench_.settling.to_the_end(rough));
  if (alone.test.size() == 0) return std::nullopt;
  Naming::Odds odds = bench_.naming.odds(alone.test, with.test);
  odds.probability = allowing_for_scatter(odds.probability, bench_.settling, base, alone, with);
  const double gain = base.fit.cost - alone.fit.cost;
  return Instead{std::move(alone), odds, gain};
}

}  // namespace discovery
}  // namespace anthrob
