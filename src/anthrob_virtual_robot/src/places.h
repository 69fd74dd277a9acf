#pragma once

#include <string>
#include <vector>

#include "anthrob_reference/parameters.h"

namespace anthrob::virtual_robot {

// Where hidden laws can sit, in the words of the effect catalogue.

std::vector<std::string> muscle_places(const reference::ArmParameters& arm);
/// Every muscle, and "all".
std::vector<std::string> muscle_places_and_all(const reference::ArmParameters& arm);
std::vector<std::string> joint_places(const reference::ArmParameters& arm);
std::vector<std::string> elbow_only(const reference::ArmParameters& arm);
std::vector<std::string> shoulder_only(const reference::ArmParameters& arm);
std::vector<std::string> global_place(const reference::ArmParameters& arm);
std::vector<std::string> world_axes(const reference::ArmParameters& arm);
std::vector<std::string> level_axes(const reference::ArmParameters& arm);
std::vector<std::string> bodies(const reference::ArmParameters& arm);
/// TO/FROM
std::vector<std::string> muscle_pairs(const reference::ArmParameters& arm);
/// MUSCLE/k/axis of the points beyond the first joint that the muscle crosses; those before it are
/// errors of calibration.
std::vector<std::string> landing_points(const reference::ArmParameters& arm);

/// Path entry before the first and before the last segment that crosses a joint.
std::size_t leaving_segment(const reference::MuscleParameters& muscle);
std::size_t crossing_segment(const reference::MuscleParameters& muscle);

}  // namespace anthrob::virtual_robot
