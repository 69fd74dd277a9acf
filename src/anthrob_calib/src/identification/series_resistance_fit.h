#pragma once

#include <optional>
#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "identification/estimate.h"

namespace anthrob {
namespace identification {

/// Averages over one level of the reference voltage: a point of Figure 7.11b.
struct LoadPoint {
  double reference;  ///< V_ref [V]
  double voltage;    ///< V_L at the load resistor [V]
  double current;    ///< [A]
};

/// An ECU on one load resistor.
struct LoadRecording {
  std::string name;
  int specimen = 1;                 ///< which ECU
  double load_resistance = 0.0;     ///< R_L as printed on it [ohm]
  double current_gain_sigma = 0.0;  ///< relative standard error of the current probe
  std::vector<LoadPoint> points;

  /// Reads columns `resistor/reference`, `oscilloscope/voltage`, `oscilloscope/current` and the
  /// keys `specimen` and `rig` of meta.yaml (docs/calibration.md).
  /// @throws BadInput with one line
  static LoadRecording read(const Dataset& recording);
};

/// The power stage as a resistor in series (Figure 7.11b):
///   V_L = (1 + gain) (V_ref - R i) + offset.
/// `gain` is that of the voltage measurement against the ECU's reference. One load cannot tell it
/// from R, because then i grows with V_ref; two can.
struct SeriesResistanceFit {
  Estimate resistance;           ///< R_ECU [ohm]
  std::optional<Estimate> gain;  ///< [1]; taken as 0 with a single load
  Estimate offset;               ///< of all voltages and the current probe [V]

  double predicted_voltage(const LoadPoint& point) const;
};

/// @throws BadInput if there are too few points, or if the resistance would not be positive
SeriesResistanceFit fit_series_resistance(const std::vector<LoadRecording>& recordings);

/// Root mean square of predicted minus measured load voltages [V].
double series_resistance_error(const SeriesResistanceFit& fit,
                               const std::vector<LoadRecording>& recordings);

}  // namespace identification
}  // namespace anthrob
