#include "ros/scope/scope_over_ros.h"

#include "ros/scope/bag_source.h"
#include "ros/scope/ros_topics.h"

namespace anthrob {

std::unique_ptr<ScopeModel> scope_over_ros() {
  return std::make_unique<ScopeModel>(std::make_unique<RosTopics>(), open_recording);
}

}  // namespace anthrob
