#include "scope/quantity.h"

#include <cmath>
#include <map>
#include <utility>

namespace anthrob {

std::optional<std::string> standard_unit(const std::string& type, const std::string& field) {
  static const std::map<std::pair<std::string, std::string>, const char*> kUnits = {
      {{"geometry_msgs/Twist", "angular"}, "rad/s"},
      {{"geometry_msgs/Twist", "linear"}, "m/s"},
      {{"geometry_msgs/Wrench", "force"}, "N"},
      {{"geometry_msgs/Wrench", "torque"}, "Nm"},
      {{"geometry_msgs/Pose", "position"}, "m"},
      {{"geometry_msgs/Transform", "translation"}, "m"},
      {{"sensor_msgs/Imu", "angular_velocity"}, "rad/s"},
      {{"sensor_msgs/Imu", "linear_acceleration"}, "m/s^2"},
      {{"sensor_msgs/JointState", "position"}, "rad or m"},
      {{"sensor_msgs/JointState", "velocity"}, "rad/s or m/s"},
      {{"sensor_msgs/JointState", "effort"}, "Nm or N"}};
  const auto found = kUnits.find({type, field});
  if (found == kUnits.end()) return std::nullopt;
  return found->second;
}

double angle_of(double w, double x, double y, double z) {
  return 2.0 * std::atan2(std::hypot(x, y, z), std::abs(w));
}

}  // namespace anthrob
