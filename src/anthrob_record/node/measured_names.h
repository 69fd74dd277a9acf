#pragma once

#include <anthrob_msgs/MuscleStates.h>
#include <anthrob_msgs/SphericalJointStates.h>
#include <sensor_msgs/JointState.h>

#include <set>
#include <string>
#include <vector>

namespace anthrob {

/// Names in a message of which it holds what recordings are made for, as numbers: a back end names
/// a muscle with NaN where its ECU did not answer. Whose force has once been a number has a sensor,
/// and is measured with it only.
class MeasuredNames {
 public:
  std::vector<std::string> operator()(const anthrob_msgs::MuscleStates& message);
  std::vector<std::string> operator()(const sensor_msgs::JointState& message) const;
  std::vector<std::string> operator()(const anthrob_msgs::SphericalJointStates& message) const;

 private:
  std::set<std::string> with_force_;
};

}  // namespace anthrob
