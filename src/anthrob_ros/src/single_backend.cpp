#include "anthrob_ros/single_backend.h"

#include <anthrob_msgs/MuscleStates.h>
#include <ros/network.h>

#include <algorithm>
#include <vector>

#include "anthrob_core/errors.h"
#include "remote_call.h"

namespace anthrob {

namespace {

constexpr double kPatience = 2.0;  // [s] for an answer

/// Whether somebody answers there, or accepts the connection without answering: a process that was
/// stopped, or that a debugger holds, may continue at any time. If the host is gone, this takes
/// kPatience.
bool answers(const std::string& host, std::uint32_t port) {
  XmlRpc::XmlRpcValue caller;
  caller[0] = ros::this_node::getName();
  const Reach reach = remote_call(host, port, "getPid", caller, kPatience).reach;
  return reach == Reach::kAnswered || reach == Reach::kSilent;
}

/// Whether the node is there; the master also lists those that were killed.
bool lives(const std::string& node) {
  XmlRpc::XmlRpcValue args, result, uri;
  args[0] = ros::this_node::getName();
  args[1] = node;
  if (!ros::master::execute("lookupNode", args, result, uri, false)) return false;
  std::string host;
  std::uint32_t port;
  return ros::network::splitURI(uri, host, port) && answers(host, port);
}

/// Whether they are alive or not.
std::vector<std::string> publishers_of(const std::string& topic) {
  XmlRpc::XmlRpcValue args, result, state;
  args[0] = ros::this_node::getName();
  std::vector<std::string> names;
  if (!ros::master::execute("getSystemState", args, result, state, false)) return names;
  XmlRpc::XmlRpcValue& publishers = state[0];
  for (int i = 0; i < publishers.size(); ++i) {
    if (static_cast<std::string>(publishers[i][0]) != topic) continue;
    XmlRpc::XmlRpcValue& nodes = publishers[i][1];
    for (int k = 0; k < nodes.size(); ++k) names.push_back(nodes[k]);
  }
  return names;
}

}  // namespace

std::optional<std::string> living_publisher(const std::string& topic) {
  for (const std::string& node : publishers_of(topic)) {
    if (node != ros::this_node::getName() && lives(node)) return node;
  }
  return std::nullopt;
}

ros::Publisher claim_robot(ros::NodeHandle& nh) {
  const ros::Publisher claim = nh.advertise<anthrob_msgs::MuscleStates>("muscle_states", 100);
  const std::optional<std::string> other = living_publisher(claim.getTopic());
  if (!other) return claim;
  restore_time();
  throw BadInput(claim.getTopic() + ": " + *other +
                 " publishes it already; stop that simulator or driver first");
}

void refuse_other_clocks() {
  const std::optional<std::string> other = living_publisher("/clock");
  if (!other) return;
  throw BadInput("/clock: " + *other +
                 " publishes it already; a second one would turn time back and forth: give each "
                 "simulator a ROS master of its own (roslaunch -p PORT)");
}

void refuse_other_back_ends(ros::NodeHandle& nh, const std::string& own) {
  if (own.empty()) return;
  const std::string topic = nh.resolveName("muscle_states"), meant = nh.resolveName(own);
  for (const std::string& node : publishers_of(topic)) {
    if (node == meant || !lives(node)) continue;
    restore_time(meant);
    throw BadInput("parameter ~back_end: " + own + ": but " + node + " publishes " + topic +
                   "; stop it first, or use the robot that is running (launch files: sim:=false; "
                   "rosrun: rosparam delete " +
                   ros::this_node::getName() + "/back_end)");
  }
}

bool name_is_taken() {
  const std::string& name = ros::this_node::getName();
  if (!lives(name)) return false;
  ROS_FATAL_STREAM(
      name << " runs already; stop it first, or give this node another name (__name:=NAME)");
  return true;
}

void restore_time(const std::string& ending) {
  // The living publisher of the clock may have the same name as the refused node.
  const std::vector<std::string> clocks = publishers_of("/clock");
  const bool stays = std::any_of(clocks.begin(), clocks.end(), [&](const std::string& node) {
    return node != ending && lives(node);
  });
  ros::param::set("/use_sim_time", stays);
}

}  // namespace anthrob
