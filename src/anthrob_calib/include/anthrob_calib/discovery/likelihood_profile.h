#pragma once

#include <optional>

#include "anthrob_calib/discovery/candidate.h"
#include "anthrob_calib/discovery/model_fit.h"

namespace anthrob {
namespace discovery {

/// The likelihood profile of an effect's size: by how much a fit is worse if the effect is so many
/// doses from neutral, the ordinary parameters fitted again. That is what they cannot take up, also
/// where it is not linear. The mean of both sides: what is in the data already makes one of them
/// higher and the other lower.
/// @param base fitted without the effect, its sensitivities known
/// @param size index among the candidate's
/// @return [nat]; nothing if a side cannot be simulated
std::optional<double> profile_rise(const ModelFit& fit, const Fitted& base,
                                   const Candidate& candidate, std::size_t size, double doses);

}  // namespace discovery
}  // namespace anthrob
