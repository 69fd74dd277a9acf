#include "discover.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "admission/admission.h"
#include "anthrob_core/text.h"
#include "baseline/baseline.h"
#include "conclusion/conclusion.h"
#include "conclusion/withheld.h"
#include "detectability/detectability.h"
#include "diagnosis/diagnosis.h"
#include "hypotheses/axis_doses.h"
#include "hypotheses/hypotheses.h"
#include "hypotheses/periods_from_data.h"
#include "hypotheses/screening.h"
#include "measurement/measurement.h"
#include "search/search.h"

namespace anthrob {
namespace discovery {

namespace {

void say_remarks(const Admission& admission, const Observer& observer) {
  for (const std::string& remark : admission.remarks) observer.say(remark);
  for (const std::string& remark : remarks_on_ordinary_parameters(admission.question)) {
    observer.say(remark);
  }
}

/// Recordings as the model's sensors would have them. What was given is judged first, so that
/// nothing that cannot answer is corrected until it can.
/// @return and how they were taken
std::pair<Admission, Measurement> admit_as_taken(const Evaluator& evaluator,
                                                 const Question& question) {
  Description stated = as_stated(*evaluator.model(), question);
  Admission admission = admit(evaluator, stated.question);
  Description description = describe(evaluator, std::move(stated));
  if (description.corrected) admission = admit(evaluator, description.question);
  append(description.remarks, admission.remarks);
  return {std::move(admission), std::move(description.measurement)};
}

std::string no_period_of(const std::string& candidate) {
  return candidate +
         ": not looked for, as no effort of a driven joint repeats along its way in these "
         "recordings";
}

}  // namespace

Answer discover(const Evaluator& evaluator, const Question& question, const Observer& observer) {
  const Options& options = question.options;
  if (const auto invalid = invalid_option(options)) throw std::invalid_argument(*invalid);
  // A wrong effect is told at once.
  std::vector<Candidate> candidates = list_candidates(evaluator, question.effects);

  auto [admission, measurement] = admit_as_taken(evaluator, question);
  scale_doses(evaluator, admission, options.hypotheses.axis_doses, candidates);
  const Scales scales = measure_scales(evaluator, admission.train, admission.repeats,
                                       admission.lags, options.experiment);
  const auto variables =
      measured_variables(admission.train, admission.question.train, options.experiment);
  const std::vector<std::string> taken_out = take_periods_from_data(
      evaluator, admission.train, variables, options.hypotheses.periods, candidates);
  if (!question.effects.empty()) {
    for (const std::string& name : taken_out) admission.remarks.push_back(no_period_of(name));
  }
  const Hypotheses hypotheses = pose(evaluator, std::move(candidates), admission, scales);
  say_remarks(admission, observer);

  const Baseline baseline = recalibrate(hypotheses, observer);
  const Fitted& base = baseline.recalibrated.fit;

  observer.stage("screening " + std::to_string(hypotheses.candidates.size()) + " candidates");
  Screening screening(hypotheses.scan, base, hypotheses.candidates, admission.quick, admission.slow,
                      options.hypotheses.screening);
  std::vector<Score> scores = screening.scores(base);

  observer.stage("checking which effects these recordings can show");
  Detectability detectability = detect(hypotheses, base, screening, scores);

  const SearchResult found = withhold(
      hypotheses, scales,
      search(hypotheses, baseline, screening, std::move(scores), question.max_effects, observer));
  const Diagnosis diagnosis =
      diagnose(hypotheses, admission, scales, variables, baseline, found, observer);
  Answer answer =
      conclude(hypotheses, admission, measurement, scales, variables, baseline, found, diagnosis);
  answer.detectability = std::move(detectability);
  return answer;
}

}  // namespace discovery
}  // namespace anthrob
