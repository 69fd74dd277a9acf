#pragma once

#include <optional>

#include "anthrob_core/config_node.h"
#include "anthrob_ecu/control_law.h"

namespace anthrob {
namespace ecu {

// What simulator and driver both read of a model file (docs/files.md). One reader makes them accept
// the same files and refuse the others with the same message.

/// One entry of `controllers`.
struct ControllerKind {
  ControllerSettings settings;
  /// Largest references that are accepted
  double largest_position = 0.0;  ///< [rad]
  double largest_current = 0.0;   ///< [A]
  double largest_force = 0.0;     ///< [N]; 0: no force mode
};

/// Gains are bounded by kParameters, the ranges that the units accept. The simulator accepts no
/// others, because it offers the same service for changing them. `period` and `voltage_limit` only
/// have to be positive here: a simulated motor or rig may have other values than the units, and the
/// driver checks in addition what the units can do.
/// @param period [s] of an entry that need not have one; without it, `period` is required
/// @throws BadInput naming file, line and key
ControllerKind read_controller(const ConfigNode& node, std::optional<double> period = {});

/// Per-muscle gains that override those of the controller's kind: `gains` of a muscle, if it has
/// any.
/// @throws BadInput
void read_gains(const ConfigNode& muscle, ControllerSettings& settings);

/// Refuses keys that no muscle of a model file has, and gains without a controller. The simulator
/// calls it too, so that a new key cannot be missing in the table that the driver uses.
/// @throws BadInput
void check_muscle(const ConfigNode& muscle);

}  // namespace ecu
}  // namespace anthrob
