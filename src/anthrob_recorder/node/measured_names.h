#pragma once

#include <anthrob_msgs/MuscleStates.h>
#include <anthrob_msgs/SphericalJointStates.h>
#include <sensor_msgs/JointState.h>

#include <set>
#include <string>
#include <vector>

namespace anthrob {

/// Names of the muscles or joints that a message really measures. Where an ECU did not answer, the
/// message has its muscle with NaN; such a muscle is left out. A muscle whose force has ever been a
/// number has a force sensor; from then on it is left out whenever its force is NaN.
class MeasuredNames {
 public:
  std::vector<std::string> operator()(const anthrob_msgs::MuscleStates& message);
  std::vector<std::string> operator()(const sensor_msgs::JointState& message) const;
  std::vector<std::string> operator()(const anthrob_msgs::SphericalJointStates& message) const;

 private:
  std::set<std::string> with_force_;
};

}  // namespace anthrob
