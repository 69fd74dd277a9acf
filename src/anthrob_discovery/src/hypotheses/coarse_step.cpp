#include "hypotheses/coarse_step.h"

#include "judgement/judge.h"

namespace anthrob {
namespace discovery {

double coarse_step(const Evaluator& evaluator, const Experiments& train, const Scales& scales,
                   const LongerStepOptions& longer, const JudgementOptions& judgement) {
  if (evaluator.model()->muscles.empty()) return 0.0;
  Variant coarse{};
  coarse.step = longer.times * evaluator.model()->step;
  const auto both = evaluator.compare({Variant{}, coarse}, train);
  if (both[0].size() == 0 || both[1].size() == 0) return 0.0;
  const Eigen::VectorXf factors = whitener(train, scales, false);
  const Eigen::VectorXf error = (both[1] - both[0]).cwiseProduct(factors);
  for (const auto& [name, gap] : Judge(train, factors, {}, judgement).channel_gaps(error)) {
    if (gap > longer.most_error) return 0.0;
  }
  return coarse.step;
}

}  // namespace discovery
}  // namespace anthrob
