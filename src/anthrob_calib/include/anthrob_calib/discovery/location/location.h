#pragma once

#include <string>
#include <vector>

#include "anthrob_calib/discovery/discovery.h"
#include "anthrob_calib/discovery/judgement/judge.h"

namespace anthrob {
namespace discovery {

/// What the residual of a channel depends on most, as far as it tells (Dependence::kTelling):
/// "posture of elbow/position", "nothing: off by a constant", "mostly off by a constant; the rest:
/// time"; empty if nothing tells.
std::string regime_of(const std::string& channel, const std::vector<Dependence>& dependences);

/// Channels whose gap is above `least` [floors], largest share of the squared gap first, each with
/// the part of the chain to which `seams` point and with what its residual depends on.
/// @param residual of the recalibrated model, as `judge` judges it
std::vector<Place> locate(const Judge& judge, const Eigen::VectorXf& residual, double least,
                          const Scales& scales, const std::vector<SeamGap>& seams,
                          const std::vector<Dependence>& dependences);

}  // namespace discovery
}  // namespace anthrob
