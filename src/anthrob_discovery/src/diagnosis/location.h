#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/dependence.h"
#include "diagnosis/seams.h"
#include "experiment/noise_floor.h"
#include "judgement/judge.h"

namespace anthrob {
namespace discovery {

/// Where model and data disagree.
struct Place {
  std::string channel, place, subsystem, regime, unit;
  double rmse = 0.0, noise_floor = 0.0;  ///< [unit]
  double share = 0.0;                    ///< of the squared gap
  /// By how many standard errors it exceeds least_gap(); nothing if there is too little data.
  std::optional<double> significance;
};

/// What the residual of a channel depends on most, as far as it tells (DependenceOptions::telling):
/// "posture of elbow/position", "nothing: off by a constant", "mostly off by a constant; the rest:
/// time"; empty if nothing tells.
std::string regime_of(const std::string& channel, const std::vector<Dependence>& dependences,
                      double telling);

/// Channels whose gap is above `least` [floors], largest share of the squared gap first, each with
/// the part of the chain to which `seams` point and with what its residual depends on.
/// @param residual of the recalibrated model, as `judge` judges it
std::vector<Place> locate(const Judge& judge, const Eigen::VectorXf& residual, double least,
                          const Scales& scales, const std::vector<SeamGap>& seams,
                          const std::vector<Dependence>& dependences,
                          const DiagnosisOptions& options);

}  // namespace discovery
}  // namespace anthrob
