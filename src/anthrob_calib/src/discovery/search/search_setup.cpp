#include "anthrob_calib/discovery/search/search_setup.h"

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

SearchSetup::SearchSetup(const Evaluator& the_evaluator, const Question& the_question)
    : evaluator(the_evaluator),
      // A wrong effect is told at once.
      candidates(list_candidates(evaluator, the_question.effects)),
      recordings(prepare(evaluator, the_question)),
      question(recordings.question),
      variables(measured_variables(recordings.train, question.train)),
      scales(measure_scales(evaluator, recordings.train, recordings.repeats, recordings.lags)),
      train(evaluator, recordings.train, whitener(recordings.train, scales, true),
            coarse_step(evaluator, recordings.train, scales, kOfFits)),
      test(evaluator, recordings.test, whitener(recordings.test, scales, true)),
      scan(evaluator, recordings.train, train.whitening(), scanning_step(evaluator, train, scales)),
      train_judge(recordings.train, train.whitening(), scales),
      test_judge(recordings.test, test.whitening(), scales),
      convergence(evaluator, train, train_judge),
      comparison(train, test, scan, train_judge, test_judge, candidates, question.seed),
      context{evaluator, train, test, candidates, comparison, convergence} {}

void SearchSetup::stage(const std::string& what) const {
  if (question.progress && !question.progress(what)) throw Interrupted();
}

void SearchSetup::comment(const std::string& line) const {
  if (question.comment) question.comment(line);
}

}  // namespace discovery
}  // namespace anthrob
