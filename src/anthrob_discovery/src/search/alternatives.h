#pragma once

#include <vector>

#include "hypotheses/hypotheses.h"
#include "hypotheses/screening.h"
#include "question/observer.h"
#include "search/search_result.h"
#include "search/working_model.h"

namespace anthrob {
namespace discovery {

/// Single laws that could replace two named effects.
std::vector<Alternative> find_alternatives(const Hypotheses& hypotheses, const WorkingModel& model,
                                           Screening& screening, const Observer& observer);

}  // namespace discovery
}  // namespace anthrob
