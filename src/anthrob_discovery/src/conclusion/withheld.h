#pragma once

#include "experiment/noise_floor.h"
#include "hypotheses/hypotheses.h"
#include "search/search_result.h"

namespace anthrob {
namespace discovery {

/// What was found, without effects of driven axes that these recordings cannot tell: without all if
/// they leave less than noise must leave (ConclusionOptions::least_left), and without each whose
/// effort is lost in the noise (ConclusionOptions::least_effort). `record.withheld` says why, for
/// people. It also does where nothing was named, but less is left than noise must leave.
SearchResult withhold(const Hypotheses& hypotheses, const Scales& scales, SearchResult found);

}  // namespace discovery
}  // namespace anthrob
