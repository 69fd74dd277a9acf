#pragma once

#include <string>
#include <vector>

#include "experiment/measured_variable.h"
#include "fit/candidate.h"
#include "options/hypotheses.h"

namespace anthrob {
namespace discovery {

/// Given numbers of a candidate that only the recordings can tell, taken from them before any fit.
///
/// A candidate with given parameters periods_1, periods_2, ... and sizes sine_k, cosine_k, at a
/// joint whose effort is compared: the periods with which the effort that the given model misses
/// repeats along the measured way (find_periods()). Their amplitudes become the doses of the sizes.
/// Terms beyond those are taken out.
/// @param candidates those whose effort does not repeat, or is not compared, are taken out
/// @param variables measured, at the bins of `train`
/// @return names of the candidates that were taken out
std::vector<std::string> take_periods_from_data(const Evaluator& evaluator,
                                                const Experiments& train,
                                                const std::vector<MeasuredVariable>& variables,
                                                const PeriodOptions& options,
                                                std::vector<Candidate>& candidates);

}  // namespace discovery
}  // namespace anthrob
