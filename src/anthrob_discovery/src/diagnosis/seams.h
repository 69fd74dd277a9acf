#pragma once

#include <optional>
#include <string>
#include <vector>

#include "admission/admission.h"
#include "experiment/noise_floor.h"

namespace anthrob {
namespace discovery {

/// Gaps of a channel when the simulation is fed with measured values at one point (seam) of the
/// chain from command to sensor [standard deviations]. A gap that disappears arises before the
/// seam, a gap that stays arises behind it.
struct SeamGap {
  std::string place, channel;
  bool of_joint = false;  ///< place is a joint, else a muscle
  // Nothing: not compared.
  std::optional<double> commands;   ///< the whole chain replayed from its commands
  std::optional<double> voltages;   ///< from measured voltages on: without controllers
  std::optional<double> positions;  ///< measured motor positions imposed: without motors
  /// Measured joint positions imposed as well: tendons and springs alone. Only of forces.
  std::optional<double> postures;
};

/// Replays the training recordings four times, fed with measured values at one point (seam) of the
/// chain after the other. A gap that disappears arises in the part that was cut off.
std::vector<SeamGap> seam_gaps(const Evaluator& evaluator, const Admission& admission,
                               const Scales& scales, const Variant& variant);

/// Whether measured postures make a force so much worse that their own errors must be in it. Up to
/// twice as bad is natural: an imposed posture does not give way to a wrong force.
bool postures_mislead(const SeamGap& gap, const SeamOptions& options);

/// The part of the chain to which the gaps of a channel point, in words.
std::string subsystem_of(const SeamGap& gap, const SeamOptions& options);

}  // namespace discovery
}  // namespace anthrob
