#pragma once

#include <vector>

#include "admission/admission.h"
#include "experiment/evaluator.h"
#include "fit/candidate.h"
#include "options/hypotheses.h"

namespace anthrob {
namespace discovery {

/// Doses of candidates at driven joints, in the units of what was measured there: a share of the
/// effort that the given model lacks, of that over speed, or of that over range of motion. The
/// catalogue's are those of a human arm; on a small screw, ten of its smallest doses would be above
/// all efforts, and trials of sizes would begin far beyond what little is missing.
void scale_doses(const Evaluator& evaluator, const Admission& admission,
                 const AxisDoseOptions& options, std::vector<Candidate>& candidates);

}  // namespace discovery
}  // namespace anthrob
