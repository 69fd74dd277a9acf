#include "conclusion/conclusion.h"

#include "anthrob_core/text.h"
#include "conclusion/sampled_delay.h"
#include "conclusion/sizes.h"
#include "conclusion/verdict.h"

namespace anthrob {
namespace discovery {

namespace {

/// How an effect is told from its first rival.
FoundEffect with_separation(FoundEffect effect, const NamedEffect& named,
                            const Hypotheses& hypotheses, const Admission& admission,
                            const Scales& scales) {
  effect.separating_experiment = how_to_separate(effect);
  if (!named.contest) return effect;
  effect.separating_recording = plan_separation(
      hypotheses.evaluator, named.contest->named, named.contest->rival,
      admission.question.train.front(), scales, admission.train.front()->bin(), hypotheses.options);
  return effect;
}

}  // namespace

Answer conclude(const Hypotheses& hypotheses, const Admission& admission,
                const Measurement& measurement, const Scales& scales,
                const std::vector<MeasuredVariable>& variables, const Baseline& baseline,
                const SearchResult& found, const Diagnosis& diagnosis) {
  const Options& options = hypotheses.options;
  const auto sizes = measure_sizes(hypotheses, variables, found, admission.question.seed);
  Answer answer;
  answer.measurement = measurement;
  for (std::size_t e = 0; e < found.named.size(); ++e) {
    FoundEffect effect{found.named[e].found, sizes[e], {}, {}};
    answer.effects.push_back(with_separation(trusted(std::move(effect), options.judgement.trust),
                                             found.named[e], hypotheses, admission, scales));
  }
  answer.remaining = remaining_of(diagnosis, options);
  answer.given = baseline.given;
  answer.recalibrated = found.recalibrated.fit.variant;
  answer.extended = found.extended.fit.variant;
  answer.scales = scales;
  answer.search = found.record;
  answer.diagnosis = diagnosis;
  answer.remarks = admission.remarks;
  append(remarks_on_ordinary_parameters(admission.question), answer.remarks);
  append(found.record.withheld, answer.remarks);
  append(diagnosis.remarks, answer.remarks);
  answer = with_sampled_delays(std::move(answer), *hypotheses.evaluator.model(),
                               options.measurement.controller.longest);
  answer.verdict = verdict_on(!found.named.empty(), diagnosis, options.conclusion);
  const bool all_sampled = answer.effects.empty() && !found.named.empty();
  if (all_sampled && answer.verdict == Verdict::kEffectsFound) {
    answer.verdict = Verdict::kNoMissingEffect;
  }
  if (found.named.empty() && !found.record.withheld.empty()) answer.verdict = Verdict::kCannotTell;
  return answer;
}

}  // namespace discovery
}  // namespace anthrob
