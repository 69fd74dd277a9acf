#pragma once

#include <vector>

#include "anthrob_calib/discovery/discovery.h"
#include "anthrob_calib/discovery/judgement/judge.h"

namespace anthrob {
namespace discovery {

/// Channels whose gap is above `least` [floors], largest share of the squared gap first, each with
/// the part of the chain to which `seams` point and with what its residual depends on.
/// @param residual of the recalibrated model, as `judge` judges it
std::vector<Place> locate(const Judge& judge, const Eigen::VectorXf& residual, double least,
                          const Scales& scales, const std::vector<SeamGap>& seams,
                          const std::vector<Dependence>& dependences);

}  // namespace discovery
}  // namespace anthrob
