#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <cstdint>
#include <optional>
#include <string>

namespace anthrob {

/// How far a call of another process got.
enum class Reach {
  kAnswered,
  kRefused,       ///< nobody listens there: certain, and known at once
  kSilent,        ///< somebody accepts connections, and did not answer in time
  kBroken,        ///< the connection ended without a proper answer
  kUnreachable,   ///< no connection in time, or no such host
  kNoDescriptor,  ///< this process has no descriptor left for a connection
};

struct Reply {
  Reach reach = Reach::kSilent;
  XmlRpc::XmlRpcValue value;  ///< valid if it answered
};

/// An XML-RPC call that never waits longer than `patience`, unlike those of roscpp, which wait for
/// ever where a process was stopped.
/// @param patience [s]; ends early when ROS shuts down
Reply remote_call(const std::string& host, std::uint32_t port, const std::string& method,
                  const XmlRpc::XmlRpcValue& arguments, double patience);

/// The value in an answer of ROS's form [1, message, value]; none if it has another form, or says
/// that the call failed.
std::optional<XmlRpc::XmlRpcValue> payload_of(const Reply& reply);

}  // namespace anthrob
