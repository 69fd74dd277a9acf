#include "hypotheses/hypotheses.h"

#include "fit/reduction.h"
#include "hypotheses/coarse_step.h"

namespace anthrob {
namespace discovery {

namespace {

/// Where the step for scans is too long, that of fits is used.
double scanning_step(const Evaluator& evaluator, const ModelFit& train, const Scales& scales,
                     const Options& options) {
  const double step = coarse_step(evaluator, train.experiments(), scales, options.hypotheses.scans,
                                  options.judgement);
  return step > 0.0 ? step : train.coarse_step();
}

}  // namespace

Hypotheses::Hypotheses(const Evaluator& the_evaluator, std::vector<Candidate> the_candidates,
                       ModelFit the_train, ModelFit the_test, ModelFit the_scan,
                       const Scales& scales, const Options& the_options, std::uint64_t seed)
    : evaluator(the_evaluator),
      options(the_options),
      candidates(std::move(the_candidates)),
      train(std::move(the_train)),
      test(std::move(the_test)),
      scan(std::move(the_scan)),
      train_judge(train.experiments(), train.whitening(), scales, options.judgement),
      test_judge(test.experiments(), test.whitening(), scales, options.judgement),
      convergence(evaluator, train, train_judge),
      comparison(train, test, scan, train_judge, test_judge, candidates, options.hypotheses, seed) {
}

Tested Hypotheses::tested(Fitted fit) const {
  Eigen::VectorXf residual = test.residual(fit.variant);
  return {std::move(fit), std::move(residual)};
}

std::optional<Fitted> Hypotheses::without(std::size_t effect, std::size_t candidate,
                                          const Fitted& fit) const {
  return without_effect(evaluator, train, fit, effect, candidates[candidate]);
}

Hypotheses pose(const Evaluator& evaluator, std::vector<Candidate> candidates,
                const Admission& admission, const Scales& scales) {
  const Options& options = admission.question.options;
  ModelFit train(
      evaluator, admission.train, whitener(admission.train, scales, true), options.fit,
      coarse_step(evaluator, admission.train, scales, options.hypotheses.fits, options.judgement));
  ModelFit test(evaluator, admission.test, whitener(admission.test, scales, true), options.fit);
  ModelFit scan(evaluator, admission.train, train.whitening(), options.fit,
                scanning_step(evaluator, train, scales, options));
  return Hypotheses(evaluator, std::move(candidates), std::move(train), std::move(test),
                    std::move(scan), scales, options, admission.question.seed);
}

}  // namespace discovery
}  // namespace anthrob
