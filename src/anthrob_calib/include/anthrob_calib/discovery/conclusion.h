#pragma once

#include "anthrob_calib/discovery/search/screening.h"
#include "anthrob_calib/discovery/search/working_model.h"

namespace anthrob {
namespace discovery {

/// Gaps smaller than this are not located or counted [floors]; a gap that was worth naming an
/// effect for counts.
double least_gap(const Answer& answer);

/// Lists single laws that could replace two named effects (Answer::alternatives).
void find_alternatives(const SearchSetup& setup, const WorkingModel& model, Screening& screening,
                       Answer& answer);

/// Fills in what a finished search found: sizes with their intervals, gaps before and after, where
/// model and recordings disagree, and the verdict (steps 9 and 10 of docs/discovery_method.md).
/// @param model the effects' values and intervals are stored there as well
void conclude(const SearchSetup& setup, WorkingModel& model, Answer& answer);

}  // namespace discovery
}  // namespace anthrob
