#pragma once

#include <ros/node_handle.h>

#include <string>

namespace anthrob {

/// Values from the parameter server. A value of the wrong type is an error, so that it is not
/// silently replaced by the default.
/// @param key for the message   @throws BadInput for another type, or a number that is not finite
double number_of(const std::string& key, XmlRpc::XmlRpcValue value);
double positive_number_of(const std::string& key, XmlRpc::XmlRpcValue value);
double nonnegative_number_of(const std::string& key, XmlRpc::XmlRpcValue value);
int positive_whole_number_of(const std::string& key, XmlRpc::XmlRpcValue value);
/// Of a simulator that a node commands without stepping it: above 0 and at most 1.
double real_time_factor_of(const std::string& key, XmlRpc::XmlRpcValue value);
bool truth_of(const std::string& key, XmlRpc::XmlRpcValue value);
std::string text_of(const std::string& key, XmlRpc::XmlRpcValue value);

/// Sets `to` to a parameter, if the parameter exists.
/// @param read one of the functions above
template <typename T, typename Read>
void take(const ros::NodeHandle& settings, const std::string& key, Read read, T& to) {
  XmlRpc::XmlRpcValue value;
  if (settings.getParam(key, value)) to = read(key, value);
}

/// A text parameter that must exist.
/// @param what is expected, for the message   @throws BadInput if it is missing or empty
std::string required(const ros::NodeHandle& settings, const std::string& key,
                     const std::string& what);

/// The file of the parameter ~model, which may also be a name such as anthrob/II.
/// @throws BadInput if it is missing, or there is no such model
std::string required_model(const ros::NodeHandle& settings);

}  // namespace anthrob
