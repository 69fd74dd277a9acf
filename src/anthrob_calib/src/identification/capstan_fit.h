#pragma once

#include <optional>
#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "identification/estimate.h"

namespace anthrob {
namespace identification {

/// A piece of steady motion of a line over an eyelet: one point of Figure 7.9c.
struct SlidingPoint {
  std::string recording;
  double load = 0.0;     ///< weight at the end of the line [N]
  double turning = 0.0;  ///< alpha = pi - beta, by which the eyelet turns the line [rad]
  bool pulling = true;   ///< the weight rises
  Estimate force;        ///< mean at the motor's side [N]
};

/// One recording of an eyelet.
struct EyeletRecording {
  std::string name;
  int specimen = 1;
  double turning_sigma = 0.0;           ///< standard error of the turning angle [rad]
  std::vector<double> t, speed, force;  ///< [s], [rad/s] smoothed, [N]
  std::vector<SlidingPoint> points;

  /// Reads columns `tendon/position`, `tendon/force`, `weight/load` and the keys `specimen` and
  /// `rig` of meta.yaml (docs/calibration.md); finds where the line moves steadily.
  /// @throws BadInput with one line
  static EyeletRecording read(const Dataset& recording);
};

/// Coulomb friction of a line on an eyelet (4.73), (4.74):
///   f = load exp(+- mu alpha) + offset,  + while pulling, - while relaxing.
struct CapstanFit {
  std::optional<Estimate> pulling, relaxing;  ///< mu_k
  Estimate both;                              ///< mean of the two, or the one there is
  std::optional<Estimate> offset;  ///< of the force sensor [N]; needs two loads, else taken as 0

  double predicted_force(const SlidingPoint& point) const;
};

/// mu_k of one point by itself, as in Figure 7.9d.
double capstan_coefficient(const SlidingPoint& point, double offset);

/// @throws BadInput if there are too few points, or if the friction would not be positive
CapstanFit fit_capstan(const std::vector<SlidingPoint>& points, double turning_sigma);

/// Root mean square of predicted minus measured mean forces [N].
double capstan_error(const CapstanFit& fit, const std::vector<SlidingPoint>& points);

}  // namespace identification
}  // namespace anthrob
