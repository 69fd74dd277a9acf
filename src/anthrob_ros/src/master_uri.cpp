#include "anthrob_ros/master_uri.h"

#include <cstdlib>
#include <regex>

namespace anthrob {

namespace {

bool is_address(const std::string& uri) {
  // As roscpp reads it: a host has no colon, so that there are no addresses of IPv6.
  static const std::regex kAddress("http://[^/:\\s]+:([0-9]{1,5})/?");
  std::smatch match;
  if (!std::regex_match(uri, match, kAddress)) return false;
  constexpr int kLastPort = 65535;
  const int port = std::stoi(match[1]);
  return port >= 1 && port <= kLastPort;
}

}  // namespace

std::optional<std::string> wrong_master_uri(const std::vector<std::string>& arguments) {
  const std::string expected = "expected http://HOST:PORT, such as http://localhost:11311";
  const std::string remapping = "__master:=";
  for (const std::string& argument : arguments) {
    if (argument.rfind(remapping, 0) != 0) continue;
    const std::string uri = argument.substr(remapping.size());
    if (is_address(uri)) return std::nullopt;
    return "__master: '" + uri + "': " + expected;
  }
  const char* const uri = std::getenv("ROS_MASTER_URI");
  if (uri == nullptr) return "ROS_MASTER_URI: not set; " + expected;
  if (is_address(uri)) return std::nullopt;
  return "ROS_MASTER_URI: '" + std::string(uri) + "': " + expected;
}

}  // namespace anthrob
