#pragma once

#include <ros/ros.h>

#include <string>

#include "anthrob_mocap/core/errors.h"

namespace anthrob {
namespace mocap {

/// A parameter that must be there.
inline std::string required(const ros::NodeHandle& settings, const std::string& key,
                            const std::string& what) {
  std::string value;
  if (!settings.getParam(key, value) || value.empty()) {
    throw BadInput("parameter ~" + key + ": missing; expected " + what);
  }
  return value;
}

/// Runs a node; what goes wrong becomes one line and the exit status of its kind.
template <typename Body>
int run_node(Body body) {
  try {
    body();
  } catch (const BadInput& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(ros::this_node::getName() << ": " << error.what());
    return 1;
  }
  return 0;
}

}  // namespace mocap
}  // namespace anthrob
