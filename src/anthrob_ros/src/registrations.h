#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <map>
#include <optional>
#include <set>
#include <string>

#include "remote_call.h"

namespace anthrob {

/// Names that the ROS master knows, or should know, of one node.
struct Registrations {
  std::set<std::string> published, subscribed, services;

  std::size_t size() const { return published.size() + subscribed.size() + services.size(); }
  void add(const Registrations& others);
  /// Those that `others` lacks.
  Registrations without(const Registrations& others) const;
  /// One of them, and how many more there are.
  std::string text() const;
};

/// @param state answer to the master's getSystemState   @return none if it is none
std::optional<Registrations> registrations_of(const std::string& node, XmlRpc::XmlRpcValue state);

/// Who publishes each topic that a node subscribes to.
using PublishersByTopic = std::map<std::string, std::set<std::string>>;
/// @param state as above; one of another form has none
PublishersByTopic publishers_for(const std::set<std::string>& topics, XmlRpc::XmlRpcValue state);

/// What the master knows of this node.
struct MasterAnswer {
  Reach reach;
  std::optional<Registrations> known;  ///< only with kAnswered, and not with every answer
  PublishersByTopic publishers;        ///< for what it subscribes to
};
MasterAnswer ask_master(double patience);

/// Those of them that this node still offers.
Registrations still_offered(const Registrations& registrations);

/// Registers these at the master again, and connects to the publishers that it names. Connections
/// to publishers that it does not know any more stay: an emergency stop may come from there.
/// @return false if the master or this node's own server does not answer properly
bool register_again(const Registrations& missing, double patience);

/// Asks the master who publishes this topic, and connects to exactly those. The master itself tells
/// of a new publisher only once, whether that arrives or not.
/// @return false as above
bool refresh_publishers(const std::string& topic, double patience);

}  // namespace anthrob
