#include "anthrob_calib/discovery/found_effect.h"

#include "anthrob_calib/discovery/separating_experiment.h"

namespace anthrob {
namespace discovery {

FoundEffect found_effect(const ShortList& list, const std::vector<Candidate>& candidates) {
  const Named& best = list.named.front();
  const EffectInfo& info = candidates[best.candidate].effect->info();
  FoundEffect effect;
  effect.id = info.id;
  effect.name = info.name;
  effect.place = candidates[best.candidate].place;
  effect.probability = best.probability;
  effect.evidence = best.evidence;
  for (std::size_t i = 1; i < list.named.size(); ++i) {
    const Named& other = list.named[i];
    if (other.probability < kMentioned) continue;
    const Candidate& rival = candidates[other.candidate];
    effect.rivals.push_back(
        {rival.effect->info().id, rival.place, other.probability, other.evidence});
  }
  return effect;
}

void name_instead(const Candidate& fuller, const Naming::Odds& odds, FoundEffect& effect) {
  const double both = effect.probability;
  effect.rivals.insert(effect.rivals.begin(),
                       {effect.id, effect.place, (1.0 - odds.probability) * both, effect.evidence});
  effect.id = fuller.effect->info().id;
  effect.name = fuller.effect->info().name;
  effect.probability = odds.probability * both;
  effect.evidence += odds.evidence;
  effect.separating_experiment = separating_experiment(effect.id, effect.rivals.front().id);
  effect.separating_recording = {};  // it was planned for the other one
}

void leave_open(const Candidate& fuller, const Naming::Odds& odds, FoundEffect& effect) {
  effect.probability *= 0.5;
  const std::string& id = fuller.effect->info().id;
  effect.rivals.insert(effect.rivals.begin(),
                       {id, fuller.place, effect.probability, effect.evidence + odds.evidence});
  effect.separating_experiment = separating_experiment(effect.id, id);
  effect.separating_recording = {};  // it was planned for another one
}

}  // namespace discovery
}  // namespace anthrob
