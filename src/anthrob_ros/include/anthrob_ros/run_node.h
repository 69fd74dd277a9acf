#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace anthrob {

/// What a node tells of itself when it is asked with --help, and holds its starters to.
struct NodeInfo {
  struct Parameter {
    std::string key;      ///< in the node's own namespace
    std::string meaning;  ///< with unit and default, or that it must be there
  };
  std::string name;  ///< unless __name:= is given; begins the line of what is no bad input
  std::string purpose;
  std::vector<Parameter> parameters;
  std::uint32_t options = 0;  ///< of ros::init
  /// Does not take the place of a living node of its name.
  bool only_one = false;

  bool has(const std::string& key) const;
};

/// What a node does. @return its exit status
using NodeBody = std::function<int(ros::NodeHandle& nh, ros::NodeHandle& settings)>;

/// Runs a node, or tells of it: what goes wrong becomes one line of the log and the exit status of
/// its kind, 2 for BadInput, for arguments that are not the node's and for a name that is taken,
/// and 1 for anything else. Parameters that the server has, but not the node, are warned of: an
/// earlier start may have left them.
/// @param body gets handles of the node's namespace and of its parameters
int run_node(int argc, char** argv, const NodeInfo& info, const NodeBody& body);

/// @param program as it was called
std::string help_of(const NodeInfo& info, const std::string& program);

/// What is wrong with arguments, the program's name left out: neither ROS's (NAME:=VALUE, of
/// parameters _KEY:=VALUE) nor --help, or the node knows no such parameter; empty if nothing is.
std::string wrong_argument(const NodeInfo& info, const std::vector<std::string>& arguments);

}  // namespace anthrob
