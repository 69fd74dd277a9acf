#include "diagnosis/diagnosis.h"

#include <algorithm>

#include "anthrob_core/text.h"
#include "diagnosis/wrap_angle.h"
#include "search/gaps.h"

namespace anthrob {
namespace discovery {

double least_gap(bool any_effect, const JudgementOptions& options) {
  return any_effect ? options.faint_gap : options.real_gap;
}

namespace {

Gap gap_of(const Judge& judge, const Eigen::VectorXf& given, const Eigen::VectorXf& recalibrated,
           const Eigen::VectorXf& after) {
  return {judge.gap(given), judge.gap(recalibrated), judge.gap(after), 1.0};
}

GapComparison compare_gaps(const Hypotheses& hypotheses, const Baseline& baseline,
                           const SearchResult& found) {
  const Judge &train = hypotheses.train_judge, &test = hypotheses.test_judge;
  const Tested &first = found.recalibrated, &last = found.extended;
  GapComparison gaps;
  gaps.train = gap_of(train, baseline.given_train, first.fit.residual, last.fit.residual);
  gaps.test = gap_of(test, baseline.given_test, first.test, last.test);
  const auto given = test.channel_gaps(baseline.given_test),
             recalibrated = test.channel_gaps(first.test), after = test.channel_gaps(last.test);
  for (const auto& [name, value] : given) {
    gaps.per_channel[name] = {value, recalibrated.at(name), after.at(name), 1.0};
  }
  gaps.growth = test.growth_significance(first.test, last.test);
  gaps.learned = train.channel_gaps(last.fit.residual);
  gaps.one_sided = one_sided_gaps(train, last.fit.residual, test, last.test);
  Gaps left(train, test, hypotheses.candidates.size());
  left.begin(first.test);
  const double least = least_gap(!found.named.empty(), hypotheses.options.judgement),
               whole = left.first_excess(least);
  gaps.remaining_share = whole > 0.0 ? left.excess_of(last.test, least) / whole : 0.0;
  gaps.certain = left.certain(last);
  return gaps;
}

/// What speaks against the recordings or the floors.
std::vector<std::string> remarks_on(const GapComparison& gaps, bool has_repeats, double too_good) {
  std::vector<std::string> remarks;
  for (const OneSidedGap& gap : gaps.one_sided) remarks.push_back(remark_on(gap));
  for (const auto& [channel, gap] : gaps.learned) {
    const auto held_out = gaps.per_channel.find(channel);
    if (held_out == gaps.per_channel.end()) continue;
    const double least = std::min(gap, held_out->second.after);
    if (least > too_good) continue;
    remarks.push_back(
        channel + ": a gap of only " + short_number(least) +
        " floors: the floor is too high and hides what may be missing; " +
        (has_repeats ? "check the units of all recordings, and that --repeat shows the same robot"
                     : "check the units and the noise of all recordings"));
  }
  return remarks;
}

GapLocation locate_gap(const Hypotheses& hypotheses, const Admission& admission,
                       const Scales& scales, std::vector<MeasuredVariable> variables,
                       const SearchResult& found) {
  const DiagnosisOptions& options = hypotheses.options.diagnosis;
  const double block = hypotheses.options.judgement.block;
  const Experiments& train = admission.train;
  const Eigen::VectorXf &whitening = hypotheses.train.whitening(),
                        &recalibrated = found.recalibrated.fit.residual;
  const Variant& variant = found.recalibrated.fit.variant;
  for (MeasuredVariable& angle : wrap_angles(hypotheses.evaluator, admission.question.train, train,
                                             variant, hypotheses.options)) {
    variables.push_back(std::move(angle));
  }
  GapLocation location;
  location.regimes = regime_gaps(train, variables, recalibrated, whitening, scales);
  location.dependences =
      find_dependences(train, variables, recalibrated, whitening, options.dependence, block);
  location.remaining = find_dependences(train, variables, found.extended.fit.residual, whitening,
                                        options.dependence, block);
  location.seams = seam_gaps(hypotheses.evaluator, admission, scales, variant);
  location.where = locate(hypotheses.train_judge, recalibrated,
                          least_gap(!found.named.empty(), hypotheses.options.judgement), scales,
                          location.seams, location.dependences, options);
  return location;
}

}  // namespace

Diagnosis diagnose(const Hypotheses& hypotheses, const Admission& admission, const Scales& scales,
                   const std::vector<MeasuredVariable>& variables, const Baseline& baseline,
                   const SearchResult& found, const Observer& observer) {
  const GapComparison gaps = compare_gaps(hypotheses, baseline, found);
  observer.stage("locating the gap");
  return {
      gaps, locate_gap(hypotheses, admission, scales, variables, found),
      examples_of(*admission.test.front(), admission.question.test.front(),
                  hypotheses.test.whitening(), found.recalibrated.test, found.extended.test,
                  gaps.per_channel, hypotheses.options.diagnosis.examples),
      remarks_on(gaps, !admission.question.repeats.empty(), hypotheses.options.diagnosis.too_good)};
}

}  // namespace discovery
}  // namespace anthrob
