#pragma once

#include <Eigen/Core>

#include "anthrob_calib/discovery/judge.h"
#include "anthrob_calib/discovery/model_fit.h"

namespace anthrob {
namespace discovery {

/// Least squares pays for a large gain in one channel with a little of the others, where the law
/// that brings it is of nearly the right shape only, and where the valley is flat it stops
/// anywhere. Here channels that a fit has made worse than another model has them, and above the
/// floor, weigh more and more until they are not, all unknowns free; but never for more than a
/// twentieth of what the fit has gained, nor for more than they gain themselves.
/// @param fit, judge of what is fitted   @param reference residual of the other model
/// @return the fit itself if no channel pays, or none can be spared that
Fitted spare_channels(const ModelFit& fit, const Judge& judge, const Eigen::VectorXf& reference,
                      const Fitted& fitted);

}  // namespace discovery
}  // namespace anthrob
