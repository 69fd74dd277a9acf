#pragma once

#include <anthrob_msgs/MuscleStates.h>
#include <anthrob_msgs/SphericalJointStates.h>
#include <sensor_msgs/JointState.h>

#include <string>
#include <vector>

namespace anthrob {

/// Names in a message of which it holds what recordings are made for, as numbers: a back end names
/// a muscle with NaN where its ECU did not answer.
std::vector<std::string> measured_names(const anthrob_msgs::MuscleStates& message);
std::vector<std::string> measured_names(const sensor_msgs::JointState& message);
std::vector<std::string> measured_names(const anthrob_msgs::SphericalJointStates& message);

}  // namespace anthrob
