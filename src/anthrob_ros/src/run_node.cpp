#include "anthrob_ros/run_node.h"

#include "anthrob_config/errors.h"

namespace anthrob {

int run_node(const std::string& name, const NodeBody& body) {
  // They outlive those of the body: without one nothing is logged.
  ros::NodeHandle nh, settings("~");
  try {
    return body(nh, settings);
  } catch (const BadInput& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(name << ": " << error.what());
    return 1;
  }
}

}  // namespace anthrob
