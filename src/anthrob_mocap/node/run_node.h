#pragma once

#include <ros/ros.h>

#include "anthrob_config/errors.h"
#include "anthrob_mocap/core/errors.h"

namespace anthrob {
namespace mocap {

/// Runs a node; what goes wrong becomes one line and the exit status of its kind.
template <typename Body>
int run_node(Body body) {
  const ros::NodeHandle handle;  // outlives those of the body: without one nothing is logged
  try {
    body();
  } catch (const BadInput& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  } catch (const anthrob::BadInput& error) {
    ROS_FATAL_STREAM(error.what());  // of a parameter
    return 2;
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(ros::this_node::getName() << ": " << error.what());
    return 1;
  }
  return 0;
}

}  // namespace mocap
}  // namespace anthrob
