#pragma once

#include "anthrob_core/config_node.h"
#include "anthrob_reference/parameters.h"
#include "random.h"

namespace anthrob::virtual_robot {

/// Errors of an ordinary calibration: half ranges of uniform distributions.
struct NuisanceRanges {
  double rest_tendon_length = 0.0;               ///< [m]
  double spindle_radius = 0.0;                   ///< [m]
  double path_point = 0.0;                       ///< each coordinate [m]
  double viscous_low = 1.0, viscous_high = 1.0;  ///< factor on the joints' damping

  static NuisanceRanges load(const ConfigNode& node);
};

/// The same arm with errors of calibration.
reference::ArmParameters miscalibrated(const reference::ArmParameters& arm,
                                       const NuisanceRanges& ranges, Random random);

}  // namespace anthrob::virtual_robot
