#include "search/alternatives.h"

#include "search/common_law.h"

namespace anthrob {
namespace discovery {

std::vector<Alternative> find_alternatives(const Hypotheses& hypotheses, const WorkingModel& model,
                                           Screening& screening, const Observer& observer) {
  std::vector<Alternative> alternatives;
  const auto& named = model.named;
  const auto& candidates = hypotheses.candidates;
  const CommonLaw common(hypotheses, screening);
  for (std::size_t later = 1; later < named.size(); ++later) {
    for (std::size_t earlier = 0; earlier < later; ++earlier) {
      const CommonLaw::Part a{earlier, named[earlier].candidate}, b{later, named[later].candidate};
      for (std::size_t law = 0; law < candidates.size(); ++law) {
        if (model.is_named(law) || !common.may_be(law, a.candidate, b.candidate)) continue;
        const Candidate& alone = candidates[law];
        observer.stage("checking whether " + alone.name() + " alone can replace " +
                       candidates[a.candidate].name() + " and " + candidates[b.candidate].name());
        const auto instead = common.instead(law, model.base, {a, b});
        if (!instead || instead->odds.probability < hypotheses.options.search.mentioned) continue;
        const std::string& id = alone.effect->info().id;
        alternatives.push_back({id,
                                alone.effect->info().name,
                                alone.place,
                                {earlier, later},
                                instead->odds.probability,
                                instead->odds.evidence});
      }
    }
  }
  return alternatives;
}

}  // namespace discovery
}  // namespace anthrob
