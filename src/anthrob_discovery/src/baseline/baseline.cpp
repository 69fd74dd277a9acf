#include "baseline/baseline.h"

#include <stdexcept>

namespace anthrob {
namespace discovery {

Baseline recalibrate(const Hypotheses& hypotheses, const Observer& observer) {
  observer.stage("fitting the ordinary parameters");
  Baseline baseline;
  baseline.given.nuisances = hypotheses.evaluator.initial_nuisances();
  baseline.given_train = hypotheses.train.residual(baseline.given);
  baseline.given_test = hypotheses.test.residual(baseline.given);
  baseline.recalibrated = hypotheses.tested(
      hypotheses.convergence.converged(baseline.given, nuisance_unknowns(hypotheses.evaluator)));
  if (baseline.given_test.size() == 0 || baseline.recalibrated.test.size() == 0) {
    throw std::runtime_error(
        "the model cannot be simulated with the inputs of the held-out recordings: replay them "
        "with anthrob_replay to see where it fails");
  }
  return baseline;
}

}  // namespace discovery
}  // namespace anthrob
