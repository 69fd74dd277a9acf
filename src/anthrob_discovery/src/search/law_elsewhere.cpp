#include "search/law_elsewhere.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "hypotheses/trials.h"

namespace anthrob {
namespace discovery {

namespace {}  // namespace

const Effect* LawElsewhere::repeated(const ShortList& list,
                                     const std::vector<std::size_t>& named) const {
  const auto& candidates = hypotheses_.candidates;
  for (const FittedCandidate& entry : list.entries) {
    const Candidate& here = candidates[entry.candidate];
    if (here.is_everywhere()) continue;
    for (const std::size_t other : named) {
      const Candidate& there = candidates[other];
      if (there.effect == here.effect && there.owner() != here.owner()) return here.effect;
    }
  }
  return nullptr;
}

/// The law at all places of the muscles, joints or bodies at which it is not named, by new doses.
std::vector<Score> LawElsewhere::asked(const Effect* law, const std::vector<std::size_t>& named,
                                       const Fitted& base) const {
  const auto& candidates = hypotheses_.candidates;
  const auto is_asked = [&](const Score& score) {
    const Candidate& candidate = candidates[score.candidate];
    if (candidate.effect != law || candidate.is_everywhere()) return false;
    return std::none_of(named.begin(), named.end(), [&](std::size_t other) {
      return candidates[other].effect == law && candidates[other].owner() == candidate.owner();
    });
  };
  const auto chosen = [&] {
    std::vector<Score> scores = screening_.scores(base);
    scores.erase(std::remove_if(scores.begin(), scores.end(),
                                [&](const Score& score) { return !is_asked(score); }),
                 scores.end());
    return scores;
  };
  const std::vector<Score> old = chosen();
  screening_.renew(base, old, old.size());
  return chosen();
}

/// Of each muscle, joint or body the place at which the law, alone, leaves least; best first.
std::vector<Score> LawElsewhere::best_places(std::vector<Score> tried, const Fitted& base,
                                             std::size_t most) const {
  tried.erase(std::remove_if(tried.begin(), tried.end(),
                             [](const Score& score) { return !(score.gain > 0.0); }),
              tried.end());
  const std::vector<double> left =
      Trials(hypotheses_.scan, hypotheses_.candidates, hypotheses_.options.hypotheses.trials)
          .choose_sizes(base, tried);
  std::map<std::string, std::size_t> best;
  for (std::size_t i = 0; i < tried.size(); ++i) {
    if (left[i] >= base.cost) continue;
    const std::string owner = hypotheses_.candidates[tried[i].candidate].owner();
    const auto its = best.try_emplace(owner, i).first;
    if (left[i] < left[its->second]) its->second = i;
  }
  std::vector<std::size_t> order;
  for (const auto& [owner, i] : best) order.push_back(i);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return left[a] < left[b]; });
  std::vector<Score> places;
  for (std::size_t k = 0; k < std::min(most, order.size()); ++k) {
    places.push_back(std::move(tried[order[k]]));
  }
  return places;
}

/// @return nothing if the model without it cannot be simulated
std::optional<LawElsewhere::Part> LawElsewhere::part(std::size_t effect, std::size_t candidate,
                                                     const Tested& all) const {
  std::optional<Fitted> without = hypotheses_.without(effect, candidate, all.fit);
  if (!without) return std::nullopt;
  hypotheses_.train.improve(*without, hypotheses_.options.search.law_elsewhere.iterations);
  Part part;
  part.without = hypotheses_.tested(std::move(*without));
  if (part.without.test.size() == 0) return std::nullopt;
  part.alone.entries.resize(1);
  static_cast<Tested&>(part.alone.entries[0]) = all;
  part.alone.entries[0].candidate = candidate;
  hypotheses_.comparison.judge(part.without, part.alone);
  return part;
}

std::optional<LawElsewhere::Everywhere> LawElsewhere::fit(const Effect* law,
                                                          const std::vector<std::size_t>& named,
                                                          const Tested& base,
                                                          std::size_t most) const {
  const std::vector<Score> places = best_places(asked(law, named, base.fit), base.fit, most);
  if (places.size() < hypotheses_.options.search.law_elsewhere.fewest) return std::nullopt;
  Everywhere all;
  try {
    all.fit = hypotheses_.comparison.together(base, places);
  } catch (const NotSimulated&) {
    return std::nullopt;
  }
  if (all.fit.test.size() == 0) return std::nullopt;
  // The least promising first: what it does not explain is left for the others.
  for (std::size_t i = places.size(); i-- > 0;) {
    const std::size_t effect = base.fit.variant.effects.size() + i;
    std::optional<Part> its = part(effect, places[i].candidate, all.fit);
    if (!its) return std::nullopt;
    if (its->alone.entries.front().evidence > 0.0) {
      all.parts.insert(all.parts.begin(), std::move(*its));
    } else {
      all.fit = std::move(its->without);
    }
  }
  if (all.parts.size() < hypotheses_.options.search.law_elsewhere.fewest) return std::nullopt;
  return all;
}

}  // namespace discovery
}  // namespace anthrob
