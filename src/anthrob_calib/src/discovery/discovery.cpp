#include "anthrob_calib/discovery/discovery.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "anthrob_calib/discovery/conclusion.h"
#include "anthrob_calib/discovery/search/detectability.h"
#include "anthrob_calib/discovery/search/pruning.h"
#include "anthrob_calib/discovery/search/screening.h"
#include "anthrob_calib/discovery/search/search.h"
#include "anthrob_calib/discovery/search/search_setup.h"
#include "anthrob_calib/discovery/search/working_model.h"

namespace anthrob {
namespace discovery {

namespace {

/// Fits the ordinary parameters of the given model: with the result all effects are compared.
void recalibrate(const SearchSetup& setup, WorkingModel& model, Answer& answer) {
  setup.stage("fitting the ordinary parameters");
  answer.given.nuisances = setup.evaluator.initial_nuisances();
  model.given_train = setup.train.residual(answer.given);
  model.given_test = setup.test.residual(answer.given);
  model.base = setup.context.tested(
      setup.convergence.converged(answer.given, nuisance_unknowns(setup.evaluator)));
  if (model.given_test.size() == 0 || model.base.test.size() == 0) {
    throw std::runtime_error(
        "the model cannot be simulated with the inputs of the held-out recordings: replay them "
        "with anthrob_replay to see where it fails");
  }
  model.compare_with_this(answer);
}

/// What the answer cannot know.
void remark_on_ordinary_parameters(const Question& question, Answer& answer) {
  if (!question.nuisances.empty()) return;
  const std::string why =
      question.calibration_file.empty()
          ? question.model_file + ": no calibration.yaml beside it or what it extends"
          : question.calibration_file + ": lists no parameters";
  answer.remarks.push_back(
      why +
      ", so no ordinary parameters are fitted; a wrong length or radius may be reported "
      "as an effect");
}

}  // namespace

Answer discover(const Evaluator& evaluator, const Question& question) {
  const SearchSetup setup(evaluator, question);
  Answer answer;
  answer.scales = setup.scales;
  answer.remarks = setup.recordings.remarks;
  remark_on_ordinary_parameters(question, answer);
  for (const std::string& remark : answer.remarks) setup.comment(remark);
  WorkingModel model(setup);
  recalibrate(setup, model, answer);

  setup.stage("screening " + std::to_string(setup.candidates.size()) + " candidates");
  Screening screening(setup.scan, model.base.fit, setup.candidates, setup.recordings.quick,
                      setup.recordings.slow);
  std::vector<Score> scores = screening.scores(model.base.fit);
  setup.stage("checking which effects these recordings can show");
  Detectability(setup.candidates, setup.scan, model.base.fit, setup.train_judge, setup.test_judge,
                total_duration(setup.recordings.test))
      .run(screening, scores, answer);

  Pruning pruning(setup, model, answer);
  Search search(setup, model, screening, pruning, answer);
  search.run(std::move(scores));
  if (pruning.drop_improbable() && model.gaps.certain(model.base)) {
    // A law that was dropped may have kept the right one from being tried in its place.
    search.run({});
    pruning.drop_improbable();
  }
  find_alternatives(setup, model, screening, answer);
  measure_what_is_left(setup.test_judge, model.recalibrated.test, model.base.test, model.named);
  pruning.spare_channels_that_pay();
  conclude(setup, model, answer);
  return answer;
}

}  // namespace discovery
}  // namespace anthrob
