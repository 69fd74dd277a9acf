#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace anthrob {

/// A node's name and parameters: printed by --help, and checked against the command line.
struct NodeInfo {
  struct Parameter {
    std::string key;      ///< in the node's own namespace
    std::string meaning;  ///< with unit and default, or "(required)"
  };
  std::string name;  ///< unless __name:= is given; begins error messages other than BadInput
  std::string purpose;
  std::vector<Parameter> parameters;
  std::uint32_t options = 0;  ///< for ros::init
  enum class Role {
    kOther,
    kBackEnd,    ///< serves a robot: simulator or driver
    kCommander,  ///< commands or enables a robot: has the parameter ~back_end (single_backend.h)
  };
  Role role = Role::kOther;
  bool ends_by_itself = false;  ///< so that one that is stopped before has not done its work

  bool has(const std::string& key) const;
};

/// The node's work. @return its exit status
using NodeBody = std::function<int(ros::NodeHandle& nh, ros::NodeHandle& settings)>;

/// Runs a node, or prints its help. Every error becomes one line of the log and an exit status: 2
/// for BadInput, for an unknown argument and for the name of a living node, and 1 for anything
/// else. Warns of parameters on the server that the node does not know, or that neither roslaunch
/// nor the command line has set: an earlier start may have left them there.
/// Ctrl-C, SIGTERM and a closed terminal end ros::ok(). Before the body begins, also while there is
/// no master yet, they end the node at once, with the status of a stopped one.
/// @param body gets a handle of the node's namespace and one of its private parameters
int run_node(int argc, char** argv, NodeInfo info, const NodeBody& body);

/// The text that --help prints. @param program path with which the node was called
std::string help_of(const NodeInfo& info, const std::string& program);

/// What is wrong with the arguments (without the program's name); none if nothing is. Wrong are
/// arguments that are neither NAME:=VALUE, _PARAMETER:=VALUE nor --help, and parameters that the
/// node does not know.
std::optional<std::string> wrong_argument(const NodeInfo& info,
                                          const std::vector<std::string>& arguments);

}  // namespace anthrob
