#pragma once

#include <optional>
#include <string>
#include <vector>

namespace anthrob {

/// What is wrong with the address of the ROS master; none if nothing is. To be called before
/// ros::init, which aborts the program where it cannot read it, and otherwise looks for ever for a
/// master at port 0.
/// @param arguments of the program: __master:=URI there comes before ROS_MASTER_URI
std::optional<std::string> wrong_master_uri(const std::vector<std::string>& arguments);

}  // namespace anthrob
