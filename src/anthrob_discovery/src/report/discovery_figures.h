#pragma once

#include <set>
#include <string>
#include <vector>

#include "anthrob_core/files.h"
#include "conclusion/answer.h"
#include "options/diagnosis.h"

namespace anthrob {
namespace discovery {

/// Figures of the report, figures/NAME.svg:
/// example_1, ...: measured and simulated over time, and their difference, of the held-out channels
/// that changed most; gap_1, ...: the residual of the recalibrated model over the quantities on
/// which it depends most, at places with a gap; rest_1, ...: the same of the extended model.
OutputFiles discovery_figures(const Answer& answer, const DiagnosisOptions& options);

/// "example", ...
const std::set<std::string>& kinds_of_figures();

/// What the recalibrated model leaves at places that disagree, as far as it tells something: first
/// what explains most of the gap. Elsewhere a curve through noise says nothing.
std::vector<Dependence> telling_dependences_of_gaps(const Answer& answer,
                                                    const DependenceOptions& options);
/// The same of the extended model.
std::vector<Dependence> telling_dependences_of_rest(const Answer& answer,
                                                    const DependenceOptions& options);

}  // namespace discovery
}  // namespace anthrob
