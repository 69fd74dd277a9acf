#pragma once

#include <map>
#include <string>
#include <vector>

#include "anthrob_calib/discovery/discovery.h"
#include "anthrob_calib/discovery/experiment/experiment.h"

namespace anthrob {
namespace discovery {

/// The channels of a held-out recording that changed most, for figures.
/// @param whitener of the residuals, of which this experiment's come first
/// @param gaps by channel
std::vector<Example> examples_of(const Experiment& experiment, const Eigen::VectorXf& whitener,
                                 const Eigen::VectorXf& recalibrated, const Eigen::VectorXf& after,
                                 const std::map<std::string, Gap>& gaps);

}  // namespace discovery
}  // namespace anthrob
