#pragma once

#include <map>
#include <string>
#include <vector>

#include "diagnosis/gap.h"
#include "experiment/experiment.h"

namespace anthrob {
namespace discovery {

/// One channel of a held-out recording, for a figure.
struct Example {
  std::string channel, unit;
  std::vector<double> t, recalibrated, after;  ///< simulated minus measured
  std::vector<double> measured;                ///< empty for an orientation
};

/// The channels of a held-out recording that changed most, for figures.
/// @param recording of the experiment
/// @param whitener of the residuals, of which this experiment's come first
/// @param gaps by channel   @param most so many channels
std::vector<Example> examples_of(const Experiment& experiment, const Dataset& recording,
                                 const Eigen::VectorXf& whitener,
                                 const Eigen::VectorXf& recalibrated, const Eigen::VectorXf& after,
                                 const std::map<std::string, Gap>& gaps, std::size_t most);

}  // namespace discovery
}  // namespace anthrob
