#include "anthrob_ros/single_backend.h"

#include <ros/network.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpc.h>

namespace anthrob {

namespace {

/// Whether the node answers; the master also lists those that were killed.
bool lives(const std::string& node) {
  XmlRpc::XmlRpcValue args, result, uri;
  args[0] = ros::this_node::getName();
  args[1] = node;
  if (!ros::master::execute("lookupNode", args, result, uri, false)) return false;
  std::string host;
  std::uint32_t port;
  if (!ros::network::splitURI(uri, host, port)) return false;
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue caller, answer;
  caller[0] = ros::this_node::getName();
  return client.execute("getPid", caller, answer);
}

}  // namespace

std::string other_publisher(const ros::Publisher& own) {
  XmlRpc::XmlRpcValue args, result, state;
  args[0] = ros::this_node::getName();
  if (!ros::master::execute("getSystemState", args, result, state, false)) return "";
  XmlRpc::XmlRpcValue& publishers = state[0];
  for (int i = 0; i < publishers.size(); ++i) {
    if (static_cast<std::string>(publishers[i][0]) != own.getTopic()) continue;
    XmlRpc::XmlRpcValue& nodes = publishers[i][1];
    for (int k = 0; k < nodes.size(); ++k) {
      const std::string node = nodes[k];
      if (node != ros::this_node::getName() && lives(node)) return node;
    }
  }
  return "";
}

bool name_is_taken() {
  const std::string& name = ros::this_node::getName();
  if (!lives(name)) return false;
  ROS_FATAL_STREAM(name << " runs already; stop it first, or name this one otherwise");
  return true;
}

}  // namespace anthrob
