#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "hypotheses/hypotheses.h"
#include "made_experiment.h"

namespace anthrob {
namespace discovery {

/// What decisions of the search work with, of made recordings to learn from and to judge by, with
/// noise of one unit.
struct MadeProblem {
  using Recording = std::shared_ptr<const Experiment>;

  MadeProblem(const std::vector<ModelParameter>& nuisances, const Recording& learned_from,
              const Recording& held_out, const std::vector<std::string>& effects,
              double coarse_step = 0.0)
      : evaluator(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml", nuisances,
                  MadeExperiment::kStep, 1),
        hypotheses(evaluator, list_candidates(evaluator, effects),
                   ModelFit(evaluator, {learned_from}, ones(*learned_from), {}, coarse_step),
                   ModelFit(evaluator, {held_out}, ones(*held_out), {}),
                   ModelFit(evaluator, {learned_from}, ones(*learned_from), {}, coarse_step), {},
                   {}, 1) {}

  std::size_t index(const std::string& place, const std::string& id) const {
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      if (candidates[c].place == place && candidates[c].effect->info().id == id) return c;
    }
    throw std::invalid_argument(id + " @ " + place);
  }

  Evaluator evaluator;
  Hypotheses hypotheses;
  const ModelFit &train = hypotheses.train, &test = hypotheses.test;
  const Judge &train_judge = hypotheses.train_judge, &test_judge = hypotheses.test_judge;
  const std::vector<Candidate>& candidates = hypotheses.candidates;
  const CandidateComparison& comparison = hypotheses.comparison;
  const Convergence& convergence = hypotheses.convergence;

 private:
  static Eigen::VectorXf ones(const Experiment& experiment) {
    return Eigen::VectorXf::Ones(static_cast<Eigen::Index>(experiment.size()));
  }
};

}  // namespace discovery
}  // namespace anthrob
