#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "admission/admission.h"
#include "baseline/baseline.h"
#include "diagnosis/dependence.h"
#include "diagnosis/examples.h"
#include "diagnosis/gap.h"
#include "diagnosis/location.h"
#include "diagnosis/seams.h"
#include "experiment/regimes.h"
#include "judgement/one_sided_gaps.h"
#include "search/search_result.h"

namespace anthrob {
namespace discovery {

/// How much recordings and models leave between them.
struct GapComparison {
  Gap train, test;
  std::map<std::string, Gap> per_channel;  ///< held out, by "<place>/<channel>"
  /// By how many standard errors what was found makes the squared gap of a held-out channel larger;
  /// of channels that are measured in three blocks or more.
  std::map<std::string, double> growth;
  std::map<std::string, double> learned;  ///< what the extended model leaves in training [floors]
  std::vector<OneSidedGap> one_sided;     ///< of what the extended model leaves
  bool certain = false;          ///< what it leaves has a gap that is certain (certain_gap())
  double remaining_share = 0.0;  ///< of the squared gap that was there at first
};

/// Where they leave it, and what it depends on.
struct GapLocation {
  std::vector<RegimeGap> regimes;       ///< of what the recalibrated model leaves
  std::vector<Dependence> dependences;  ///< of what the recalibrated model leaves
  std::vector<Dependence> remaining;    ///< of what the extended model leaves
  std::vector<SeamGap> seams;
  std::vector<Place> where;
};

struct Diagnosis : GapComparison, GapLocation {
  std::vector<Example> examples;
  std::vector<std::string> remarks;  ///< what speaks against recordings or floors, seen only now
};

/// Gaps smaller than this are not located or counted [floors]; a gap that was worth naming an
/// effect for counts.
double least_gap(bool any_effect, const JudgementOptions& options);

/// Where recordings and models disagree ("Where" in docs/discovery_method.md).
Diagnosis diagnose(const Hypotheses& hypotheses, const Admission& admission, const Scales& scales,
                   const std::vector<MeasuredVariable>& variables, const Baseline& baseline,
                   const SearchResult& found, const Observer& observer);

}  // namespace discovery
}  // namespace anthrob
