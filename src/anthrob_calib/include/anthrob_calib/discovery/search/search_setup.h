#pragma once

#include <string>
#include <vector>

#include "anthrob_calib/discovery/discovery.h"
#include "anthrob_calib/discovery/experiment/measured_variable.h"
#include "anthrob_calib/discovery/experiment/noise_floor.h"
#include "anthrob_calib/discovery/fit/candidate.h"
#include "anthrob_calib/discovery/fit/convergence.h"
#include "anthrob_calib/discovery/fit/model_fit.h"
#include "anthrob_calib/discovery/judgement/judge.h"
#include "anthrob_calib/discovery/search/candidate_comparison.h"
#include "anthrob_calib/discovery/search/preparation.h"
#include "anthrob_calib/discovery/search/search_context.h"

namespace anthrob {
namespace discovery {

/// What a search works with and does not change: the question, its recordings and their noise, the
/// candidates, and how fits are made and judged. The members refer to each other.
struct SearchSetup {
  /// @param evaluator must outlive the setup
  /// @throws BadInput for recordings that cannot answer, or for effects that cannot be asked for
  SearchSetup(const Evaluator& evaluator, const Question& question);
  SearchSetup(const SearchSetup&) = delete;
  SearchSetup& operator=(const SearchSetup&) = delete;

  /// Reports that a stage begins. @throws Interrupted
  void stage(const std::string& what) const;
  /// Reports a line on what was found so far.
  void comment(const std::string& line) const;

  const Evaluator& evaluator;
  const std::vector<Candidate> candidates;
  const PreparedRecordings recordings;
  const Question& question;  ///< without the columns that are left out
  const std::vector<MeasuredVariable> variables;
  const Scales scales;
  const ModelFit train, test;
  /// As `train`, with differences by a still longer step: where many candidates are tried.
  const ModelFit scan;
  const Judge train_judge, test_judge;
  const Convergence convergence;
  const CandidateComparison comparison;
  const SearchContext context;
};

}  // namespace discovery
}  // namespace anthrob
