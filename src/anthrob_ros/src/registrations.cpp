#include "registrations.h"

#include <ros/connection_manager.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/service_manager.h>
#include <ros/this_node.h>
#include <ros/time.h>
#include <ros/topic_manager.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpcException.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <vector>

namespace anthrob {

namespace {

using XmlRpc::XmlRpcValue;
using Names = std::set<std::string>;

Names difference(const Names& from, const Names& others) {
  Names left;
  std::set_difference(from.begin(), from.end(), others.begin(), others.end(),
                      std::inserter(left, left.end()));
  return left;
}

Names intersection(const Names& one, const std::vector<std::string>& other) {
  const Names others(other.begin(), other.end());
  Names both;
  std::set_intersection(one.begin(), one.end(), others.begin(), others.end(),
                        std::inserter(both, both.end()));
  return both;
}

/// @param entries [[name, [node, ...]], ...]
Names names_with(const std::string& node, XmlRpcValue& entries) {
  Names names;
  for (int i = 0; i < entries.size(); ++i) {
    XmlRpcValue& nodes = entries[i][1];
    for (int k = 0; k < nodes.size(); ++k) {
      if (static_cast<std::string>(nodes[k]) == node) names.insert(entries[i][0]);
    }
  }
  return names;
}

template <class... Arguments>
XmlRpcValue arguments(const Arguments&... rest) {
  XmlRpcValue all;
  int i = 0;
  all[i++] = ros::this_node::getName();
  (void)std::initializer_list<int>{(all[i++] = rest, 0)...};
  return all;
}

/// The master, or this node's own server, which every node has for the others.
class Server {
 public:
  Server(std::string host, std::uint32_t port, double patience)
      : host_(std::move(host)), port_(port), patience_(patience) {}

  template <class... Arguments>
  std::optional<XmlRpcValue> call(const std::string& method, const Arguments&... rest) const {
    return payload_of(remote_call(host_, port_, method, arguments(rest...), patience_));
  }

 private:
  std::string host_;
  std::uint32_t port_;
  double patience_;
};

Server master(double patience) {
  return {ros::master::getHost(), ros::master::getPort(), patience};
}

const std::string& own_uri() {
  return ros::XMLRPCManager::instance()->getServerURI();
}

Server own_server(double patience) {
  std::string host;
  std::uint32_t port = 0;
  ros::network::splitURI(own_uri(), host, port);
  return {host, port, patience};
}

/// @param pairs [[topic, type], ...]
std::map<std::string, std::string> types_of(XmlRpcValue& pairs) {
  std::map<std::string, std::string> types;
  for (int i = 0; i < pairs.size(); ++i) types[pairs[i][0]] = static_cast<std::string>(pairs[i][1]);
  return types;
}

/// Addresses of the publishers to which this topic is connected.
/// @param connections as of getBusInfo: [[id, address, direction, transport, topic, ...], ...]
Names connected(XmlRpcValue& connections, const std::string& topic) {
  Names addresses;
  for (int i = 0; i < connections.size(); ++i) {
    XmlRpcValue& one = connections[i];
    const bool incoming = static_cast<std::string>(one[2]) == "i";
    if (incoming && static_cast<std::string>(one[4]) == topic) addresses.insert(one[1]);
  }
  return addresses;
}

XmlRpcValue list_of(const Names& names) {
  XmlRpcValue list;
  list.setSize(0);
  int i = 0;
  for (const std::string& name : names) list[i++] = name;
  return list;
}

/// @param kept whether connections stay that the master does not know
bool subscribe_again(const Names& topics, const Server& at, const Server& own, bool kept) {
  if (topics.empty()) return true;
  auto pairs = own.call("getSubscriptions");
  auto connections = own.call("getBusInfo");
  if (!pairs || !connections) return false;
  const auto types = types_of(*pairs);
  for (const std::string& topic : topics) {
    const auto type = types.find(topic);
    if (type == types.end()) continue;  // given up meanwhile
    auto publishers = at.call("registerSubscriber", topic, type->second, own_uri());
    if (!publishers) return false;
    Names all = kept ? connected(*connections, topic) : Names{};
    for (int i = 0; i < publishers->size(); ++i) all.insert((*publishers)[i]);
    if (!own.call("publisherUpdate", topic, list_of(all))) return false;
  }
  return true;
}

bool offer_again(const Names& services, const Server& at) {
  const std::string address = "rosrpc://" + ros::network::getHost() + ":" +
                              std::to_string(ros::ConnectionManager::instance()->getTCPPort());
  return std::all_of(services.begin(), services.end(), [&](const std::string& service) {
    return at.call("registerService", service, address, own_uri()).has_value();
  });
}

bool advertise_again(const Names& topics, const Server& at, const Server& own) {
  if (topics.empty()) return true;
  auto pairs = own.call("getPublications");
  if (!pairs) return false;
  const auto types = types_of(*pairs);
  return std::all_of(topics.begin(), topics.end(), [&](const std::string& topic) {
    const auto type = types.find(topic);
    return type == types.end() || at.call("registerPublisher", topic, type->second, own_uri());
  });
}

}  // namespace

void Registrations::add(const Registrations& others) {
  published.insert(others.published.begin(), others.published.end());
  subscribed.insert(others.subscribed.begin(), others.subscribed.end());
  services.insert(others.services.begin(), others.services.end());
}

Registrations Registrations::without(const Registrations& others) const {
  return {difference(published, others.published), difference(subscribed, others.subscribed),
          difference(services, others.services)};
}

std::string Registrations::text() const {
  for (const Names* names : {&subscribed, &services, &published}) {
    if (names->empty()) continue;
    return *names->begin() + (size() > 1 ? " and " + std::to_string(size() - 1) + " more" : "");
  }
  return "nothing";
}

std::optional<Registrations> registrations_of(const std::string& node, XmlRpcValue state) {
  try {
    return Registrations{names_with(node, state[0]), names_with(node, state[1]),
                         names_with(node, state[2])};
  } catch (const XmlRpc::XmlRpcException&) {
    return std::nullopt;
  }
}

PublishersByTopic publishers_for(const Names& topics, XmlRpcValue state) {
  PublishersByTopic publishers;
  try {
    for (int i = 0; i < state[0].size(); ++i) {
      const std::string topic = state[0][i][0];
      if (topics.count(topic) == 0) continue;
      XmlRpcValue& nodes = state[0][i][1];
      for (int k = 0; k < nodes.size(); ++k) publishers[topic].insert(nodes[k]);
    }
  } catch (const XmlRpc::XmlRpcException&) {
    publishers.clear();
  }
  return publishers;
}

MasterAnswer ask_master(double patience) {
  const Reply reply = remote_call(ros::master::getHost(), ros::master::getPort(), "getSystemState",
                                  arguments(), patience);
  const auto state = payload_of(reply);
  const auto known = state ? registrations_of(ros::this_node::getName(), *state) : std::nullopt;
  if (!known) return {reply.reach, std::nullopt, {}};
  return {reply.reach, known, publishers_for(known->subscribed, *state)};
}

Registrations still_offered(const Registrations& registrations) {
  Registrations offered;
  std::vector<std::string> topics;
  ros::TopicManager::instance()->getAdvertisedTopics(topics);
  offered.published = intersection(registrations.published, topics);
  topics.clear();
  ros::TopicManager::instance()->getSubscribedTopics(topics);
  offered.subscribed = intersection(registrations.subscribed, topics);
  for (const std::string& service : registrations.services) {
    if (ros::ServiceManager::instance()->lookupServicePublication(service))
      offered.services.insert(service);
  }
  return offered;
}

bool register_again(const Registrations& missing, double patience) {
  const Server at = master(patience), own = own_server(patience);
  try {
    // What stops the motors first.
    if (!subscribe_again(missing.subscribed, at, own, true) || !offer_again(missing.services, at) ||
        !advertise_again(missing.published, at, own)) {
      return false;
    }
    // A new master does not know that time is simulated.
    return !ros::Time::isSimTime() || at.call("setParam", std::string("/use_sim_time"), true);
  } catch (const XmlRpc::XmlRpcException&) {
    return false;
  }
}

bool refresh_publishers(const std::string& topic, double patience) {
  try {
    return subscribe_again({topic}, master(patience), own_server(patience), false);
  } catch (const XmlRpc::XmlRpcException&) {
    return false;
  }
}

}  // namespace anthrob
