#include "anthrob_calib/discovery/common_law.h"

#include <algorithm>

#include "anthrob_calib/discovery/criteria.h"
#include "anthrob_calib/discovery/reduction.h"

namespace anthrob {
namespace discovery {

bool CommonLaw::may_be(std::size_t law, std::size_t one, std::size_t other) const {
  return says_less(candidates_[one], candidates_[law]) &&
         says_less(candidates_[other], candidates_[law]);
}

std::optional<Naming::Odds> CommonLaw::odds(std::size_t law, const Tested& with,
                                            const Part& earlier, const Part& later) const {
  std::optional<Fitted> neither =
      without_effect(evaluator_, train_, with.fit, later.effect, candidates_[later.candidate]);
  if (neither) {
    neither = without_effect(evaluator_, train_, *neither, earlier.effect,
                             candidates_[earlier.candidate]);
  }
  if (!neither) return std::nullopt;
  const Tested base{*neither, test_.residual(neither->variant)};
  if (base.test.size() == 0) return std::nullopt;
  Score asked;
  asked.candidate = law;
  screening_.renew(base.fit, {asked}, 1);
  const std::vector<Score> scores = screening_.scores(base.fit);
  const auto score = std::find_if(scores.begin(), scores.end(),
                                  [&](const Score& s) { return s.candidate == law; });
  if (score == scores.end()) return std::nullopt;
  const ShortList list = naming_.weigh(base, {*score});
  if (list.named.empty()) return std::nullopt;
  const Fitted& rough = list.named.front().fit;
  const double gained = base.fit.cost - with.fit.cost;
  if (rough.cost - with.fit.cost > kOutOfReach * gained) return std::nullopt;
  const Eigen::VectorXf test = test_.residual(settling_.to_the_end(rough).variant);
  if (test.size() == 0) return std::nullopt;
  return naming_.odds(test, with.test);
}

}  // namespace discovery
}  // namespace anthrob
