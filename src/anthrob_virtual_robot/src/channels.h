#pragma once

#include <map>
#include <string>

#include "anthrob_reference/parameters.h"
#include "recording.h"

namespace anthrob::virtual_robot {

/// Difference of two runs of the same commands, by channel: its root mean square divided by that of
/// the sensor's error. "biceps_brachii/force" -> 4.2
std::map<std::string, double> difference(const Recording& a, const Recording& b,
                                         const reference::ArmParameters& arm,
                                         const SensorSettings& sensors);

/// The largest entry.
std::pair<std::string, double> worst(const std::map<std::string, double>& channels);

}  // namespace anthrob::virtual_robot
