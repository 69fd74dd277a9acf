#pragma once

#include <ros/node_handle.h>

#include <string>

namespace anthrob {

/// Values from the parameter server. One of another type must not pass for a missing one: the
/// default would be taken without a word.
/// @param key for the message   @throws BadInput for another type, or a number that is not finite
double number_of(const std::string& key, XmlRpc::XmlRpcValue value);
double positive_number_of(const std::string& key, XmlRpc::XmlRpcValue value);
double nonnegative_number_of(const std::string& key, XmlRpc::XmlRpcValue value);
int positive_whole_number_of(const std::string& key, XmlRpc::XmlRpcValue value);
bool truth_of(const std::string& key, XmlRpc::XmlRpcValue value);
std::string text_of(const std::string& key, XmlRpc::XmlRpcValue value);

/// Takes a parameter over if it is there.
/// @param read one of the above
template <typename T, typename Read>
void take(const ros::NodeHandle& settings, const std::string& key, Read read, T& to) {
  XmlRpc::XmlRpcValue value;
  if (settings.getParam(key, value)) to = read(key, value);
}

/// A text that must be there.
/// @param what is expected   @throws BadInput if it is missing or empty
std::string required(const ros::NodeHandle& settings, const std::string& key,
                     const std::string& what);

}  // namespace anthrob
