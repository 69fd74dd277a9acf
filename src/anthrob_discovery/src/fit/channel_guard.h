#pragma once

#include <Eigen/Core>

#include "fit/model_fit.h"
#include "judgement/judge.h"

namespace anthrob {
namespace discovery {

/// Protects channels that a fit has made worse. Where a law has nearly, but not quite, the right
/// shape, least squares accepts a small loss in some channels for a large gain in another one.
/// Channels that are above the floor and worse than with a reference model are given more and more
/// weight, with all unknowns free, until they are no longer worse. This stops before it costs more
/// than a twentieth of what the fit has gained, or more than those channels gain.
/// @param fit, judge of what is fitted   @param reference residual of the reference model
/// @return the fit itself if no channel got worse, or none can be protected
Fitted spare_channels(const ModelFit& fit, const Judge& judge, const Eigen::VectorXf& reference,
                      const Fitted& fitted);

}  // namespace discovery
}  // namespace anthrob
