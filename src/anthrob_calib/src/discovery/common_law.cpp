#include "anthrob_calib/discovery/common_law.h"

#include <algorithm>

#include "anthrob_calib/discovery/reduction.h"

namespace anthrob {
namespace discovery {

bool CommonLaw::may_be(std::size_t law, std::size_t one, std::size_t other) const {
  return says_less(candidates_[one], candidates_[law]) &&
         says_less(candidates_[other], candidates_[law]);
}

std::optional<Rival> CommonLaw::weigh(std::size_t law, const Fitted& fitted,
                                      const Eigen::VectorXf& held_out, const Part& earlier,
                                      const Part& later) const {
  const Candidate &both = candidates_[law], &a = candidates_[earlier.candidate],
                  &b = candidates_[later.candidate];
  std::optional<Fitted> base = without_effect(evaluator_, train_, fitted, later.effect, b);
  if (base) base = without_effect(evaluator_, train_, *base, earlier.effect, a);
  if (!base) return std::nullopt;
  const Eigen::VectorXf base_test = test_.residual(base->variant);
  if (base_test.size() == 0) return std::nullopt;
  Score asked;
  asked.candidate = law;
  screening_.renew(*base, {asked}, 1);
  const std::vector<Score> scores = screening_.scores(*base);
  const auto score = std::find_if(scores.begin(), scores.end(),
                                  [&](const Score& s) { return s.candidate == law; });
  if (score == scores.end()) return std::nullopt;
  const ShortList list = naming_.weigh(*base, base_test, {*score});
  if (list.named.empty()) return std::nullopt;
  const Fitted alone = settling_.to_the_end(list.named.front().fit);
  const Eigen::VectorXf alone_test = test_.residual(alone.variant);
  if (alone_test.size() == 0) return std::nullopt;
  Rival rival;
  rival.id = both.effect->info().id;
  rival.place = both.place;
  rival.probability = naming_.odds(alone, alone_test, fitted, held_out);
  rival.evidence = list.named.front().evidence;
  rival.instead_of = {a.name(), b.name()};
  return rival;
}

}  // namespace discovery
}  // namespace anthrob
