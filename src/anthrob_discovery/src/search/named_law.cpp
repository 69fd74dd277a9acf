#include "search/named_law.h"

#include <algorithm>
#include <utility>

#include "separation/separating_experiment.h"

namespace anthrob {
namespace discovery {

namespace {

/// @return the probability that a law had as a rival
double take_out(const Candidate& law, NamedLaw& effect) {
  const auto& info = law.effect->info();
  const auto is_it = [&](const Rival& r) { return r.id == info.id && r.place == law.place; };
  const auto its = std::find_if(effect.rivals.begin(), effect.rivals.end(), is_it);
  if (its == effect.rivals.end()) return 0.0;
  const double probability = its->probability;
  effect.rivals.erase(its);
  return probability;
}

}  // namespace

NamedLaw named_law(const ShortList& list, const std::vector<Candidate>& candidates,
                   double mentioned) {
  const FittedCandidate& best = list.entries.front();
  const EffectInfo& info = candidates[best.candidate].effect->info();
  NamedLaw effect;
  effect.id = info.id;
  effect.name = info.name;
  effect.place = candidates[best.candidate].place;
  effect.probability = best.probability;
  effect.evidence = best.evidence;
  for (std::size_t i = 1; i < list.entries.size(); ++i) {
    const FittedCandidate& other = list.entries[i];
    if (other.probability < mentioned) continue;
    const Candidate& rival = candidates[other.candidate];
    const EffectInfo& its = rival.effect->info();
    effect.rivals.push_back({its.id, its.name, rival.place, other.probability, other.evidence});
  }
  return effect;
}

Replaced name_instead(const Candidate& fuller, const CandidateComparison::Odds& odds,
                      NamedLaw effect, double mentioned) {
  const double both = effect.probability + take_out(fuller, effect);
  const Rival simpler = {effect.id, effect.name, effect.place, (1.0 - odds.probability) * both,
                         effect.evidence};
  auto& rivals = effect.rivals;
  const auto less = [&](const Rival& r) { return r.probability <= simpler.probability; };
  const auto at = std::find_if(rivals.begin(), rivals.end(), less);
  const bool is_first = simpler.probability >= mentioned && at == rivals.begin();
  if (simpler.probability >= mentioned) rivals.insert(at, simpler);
  effect.id = fuller.effect->info().id;
  effect.name = fuller.effect->info().name;
  effect.place = fuller.place;
  effect.probability = odds.probability * both;
  effect.evidence += odds.evidence;
  return {std::move(effect), is_first};
}

NamedLaw leave_open(const Candidate& fuller, const CandidateComparison::Odds& odds,
                    NamedLaw effect) {
  effect.probability = 0.5 * (effect.probability + take_out(fuller, effect));
  effect.rivals.insert(effect.rivals.begin(),
                       {fuller.effect->info().id, fuller.effect->info().name, fuller.place,
                        effect.probability, effect.evidence + odds.evidence});
  return effect;
}

std::string how_to_separate(const NamedLaw& effect) {
  return effect.rivals.empty() ? "" : separating_experiment(effect.id, effect.rivals.front().id);
}

double trust_in(const NamedLaw& effect, const TrustOptions& options, bool left_counts) {
  const double of_shape = effect.at_limit.empty() ? 1.0 : double{options.at_limit};
  const double of_channels = options.even_odds_spoilt / (options.even_odds_spoilt + effect.spoilt);
  const double of_left = left_counts ? options.even_odds / (options.even_odds + effect.left) : 1.0;
  return of_shape * of_channels * of_left;
}

}  // namespace discovery
}  // namespace anthrob
