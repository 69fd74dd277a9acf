#pragma once

#include <XmlRpcValue.h>

#include <string>

namespace anthrob {
namespace driver {

/// Values from the parameter server. One of another type must not pass for a missing one: the
/// default would be taken without a word.
/// @param key for the message   @throws BadInput for another type
double number_of(const std::string& key, XmlRpc::XmlRpcValue value);
bool truth_of(const std::string& key, XmlRpc::XmlRpcValue value);
std::string text_of(const std::string& key, XmlRpc::XmlRpcValue value);

}  // namespace driver
}  // namespace anthrob
