#pragma once

#include "conclusion/answer.h"

namespace anthrob {
namespace discovery {

/// What a finished search amounts to: sizes with their intervals, what is left, and the verdict
/// (steps 9 and 10 of docs/discovery_method.md).
Answer conclude(const Hypotheses& hypotheses, const Admission& admission,
                const Measurement& measurement, const Scales& scales,
                const std::vector<MeasuredVariable>& variables, const Baseline& baseline,
                const SearchResult& found, const Diagnosis& diagnosis);

}  // namespace discovery
}  // namespace anthrob
