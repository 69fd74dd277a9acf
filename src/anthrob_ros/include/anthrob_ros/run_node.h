#pragma once

#include <ros/ros.h>

#include <functional>
#include <string>

namespace anthrob {

/// What a node does. @return its exit status
using NodeBody = std::function<int(ros::NodeHandle& nh, ros::NodeHandle& settings)>;

/// After ros::init: runs a node; what goes wrong becomes one line of the log and the exit status of
/// its kind, 2 for BadInput and 1 for anything else.
/// @param name begins the line of anything else: BadInput names what it is about
/// @param body gets handles of the node's namespace and of its parameters
int run_node(const std::string& name, const NodeBody& body);

}  // namespace anthrob
