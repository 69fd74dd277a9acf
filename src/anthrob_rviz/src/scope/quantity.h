#pragma once

#include <optional>
#include <string>
#include <vector>

namespace anthrob {

/// A number that a topic carries: what can be plotted.
struct Quantity {
  std::string path;                 ///< "/anthrob/muscle_states/force/biceps_brachii"
  std::string topic;                ///< "/anthrob/muscle_states"
  std::string group;                ///< what is plotted together: "/anthrob/muscle_states/force"
  std::string label;                ///< within its group: "biceps_brachii"
  std::optional<std::string> unit;  ///< where it is known
};

/// The unit of a field of a standard message, whose definitions say it in prose only.
/// @param type "sensor_msgs/JointState"
std::optional<std::string> standard_unit(const std::string& type, const std::string& field);

/// [rad] of a rotation, from 0 to pi, by its quaternion.
double angle_of(double w, double x, double y, double z);

}  // namespace anthrob
