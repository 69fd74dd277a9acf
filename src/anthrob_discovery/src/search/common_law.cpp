#include "search/common_law.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "search/scatter.h"

namespace anthrob {
namespace discovery {

namespace {}  // namespace

bool CommonLaw::Instead::is_better(const CommonLawOptions& options) const {
  return odds.evidence > options.evidence && odds.probability > 0.5;
}

bool CommonLaw::Instead::is_clearly_better(const CommonLawOptions& options) const {
  return is_better(options) && odds.probability >= options.probability;
}

bool CommonLaw::may_be(std::size_t law, std::size_t one, std::size_t other) const {
  const Candidate& whole = hypotheses_.candidates[law];
  return is_nested_in(hypotheses_.candidates[one], whole) &&
         is_nested_in(hypotheses_.candidates[other], whole);
}

std::optional<std::size_t> CommonLaw::everywhere(const std::vector<Part>& parts) const {
  if (parts.size() < 2) return std::nullopt;
  const auto same_law = [&](std::size_t a, std::size_t b) {
    return hypotheses_.candidates[a].effect == hypotheses_.candidates[b].effect;
  };
  for (const Part& part : parts) {
    const bool is_part = same_law(part.candidate, parts.front().candidate) &&
                         !hypotheses_.candidates[part.candidate].is_everywhere();
    if (!is_part) return std::nullopt;
  }
  for (std::size_t law = 0; law < hypotheses_.candidates.size(); ++law) {
    if (hypotheses_.candidates[law].is_everywhere() && same_law(law, parts.front().candidate)) {
      return law;
    }
  }
  return std::nullopt;
}

std::optional<CommonLaw::Instead> CommonLaw::instead(std::size_t law, const Tested& with,
                                                     const std::vector<Part>& parts) const {
  std::optional<Fitted> none = with.fit;
  for (auto part = parts.rbegin(); none && part != parts.rend(); ++part) {
    none = hypotheses_.without(part->effect, part->candidate, *none);
  }
  if (!none) return std::nullopt;
  const Tested base = hypotheses_.tested(*none);
  if (base.test.size() == 0) return std::nullopt;
  Score asked;
  asked.candidate = law;
  screening_.renew(base.fit, {asked}, 1);
  const std::vector<Score> scores = screening_.scores(base.fit);
  const auto score = std::find_if(scores.begin(), scores.end(),
                                  [&](const Score& s) { return s.candidate == law; });
  if (score == scores.end()) return std::nullopt;
  const ShortList list = hypotheses_.comparison.weigh(base, {*score});
  if (list.entries.empty()) return std::nullopt;
  const Fitted& rough = list.entries.front().fit;
  const double gained = base.fit.cost - with.fit.cost;
  if (rough.cost - with.fit.cost > hypotheses_.options.search.out_of_reach * gained)
    return std::nullopt;
  Tested alone = hypotheses_.tested(
      *hypotheses_.convergence.to_the_end_within_reach(rough, HUGE_VAL, with.fit.cost));
  if (alone.test.size() == 0) return std::nullopt;
  CandidateComparison::Odds odds = hypotheses_.comparison.odds(alone.test, with.test);
  odds.probability = allowing_for_scatter(odds.probability, hypotheses_.convergence, base, alone,
                                          with, hypotheses_.options.search.scatter);
  const double gain = base.fit.cost - alone.fit.cost;
  return Instead{std::move(alone), odds, gain, base.test};
}

}  // namespace discovery
}  // namespace anthrob
