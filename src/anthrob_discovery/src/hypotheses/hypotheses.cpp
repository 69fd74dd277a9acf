#include "hypotheses/hypotheses.h"

#include "fit/reduction.h"
#include "hypotheses/coarse_step.h"

namespace anthrob {
namespace discovery {

namespace {

constexpr LongerStep kOfFits = {2.0, 3.0}, kOfScans = {4.0, 20.0};

/// Where the step for scans is too long, that of fits is used.
double scanning_step(const Evaluator& evaluator, const ModelFit& train, const Scales& scales) {
  const double step = coarse_step(evaluator, train.experiments(), scales, kOfScans);
  return step > 0.0 ? step : train.coarse_step();
}

}  // namespace

Hypotheses::Hypotheses(const Evaluator& the_evaluator, std::vector<Candidate> the_candidates,
                       ModelFit the_train, ModelFit the_test, ModelFit the_scan,
                       const Scales& scales, std::uint64_t seed)
    : evaluator(the_evaluator),
      candidates(std::move(the_candidates)),
      train(std::move(the_train)),
      test(std::move(the_test)),
      scan(std::move(the_scan)),
      train_judge(train.experiments(), train.whitening(), scales),
      test_judge(test.experiments(), test.whitening(), scales),
      convergence(evaluator, train, train_judge),
      comparison(train, test, scan, train_judge, test_judge, candidates, seed) {}

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
  ModelFit train(evaluator, admission.train, whitener(admission.train, scales, true),
                 coarse_step(evaluator, admission.train, scales, kOfFits));
  ModelFit test(evaluator, admission.test, whitener(admission.test, scales, true));
  ModelFit scan(evaluator, admission.train, train.whitening(),
                scanning_step(evaluator, train, scales));
  return Hypotheses(evaluator, std::move(candidates), std::move(train), std::move(test),
                    std::move(scan), scales, admission.question.seed);
}

}  // namespace discovery
}  // namespace anthrob
