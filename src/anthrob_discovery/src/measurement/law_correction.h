#pragma once

#include <optional>

#include "measurement/control_law.h"
#include "measurement/controller_algebra.h"
#include "measurement/description.h"

namespace anthrob {
namespace discovery {

/// The law that gives the recorded voltages where the model's law does not, and neither a shift of
/// stamps nor a latency does as well.
std::optional<ControlLaw> other_law(const ControllerAlgebra& algebra,
                                    const std::optional<StampShift>& shift);

/// Reports the law, and lets the search go on: with its gains, if these are all that is other; else
/// from positions, or from voltages where positions leave nothing to be compared.
/// @param config of the model file
/// @return whether the recordings now follow the model's law
bool go_on_by_other_law(const RobotModel& robot, const ConfigNode& config, const ControlLaw& law,
                        Description& description);

/// Where no law is found: what is late, or that the law is unknown.
void remark_on_voltages(const ControllerAlgebra& algebra, const std::optional<StampShift>& shift,
                        Description& description);

}  // namespace discovery
}  // namespace anthrob
