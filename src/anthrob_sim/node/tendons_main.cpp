#include <ros/ros.h>

#include "anthrob_ros/parameters.h"
#include "anthrob_sim/core/errors.h"
#include "tendon_display.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "tendons");
  ros::NodeHandle nh, settings("~");
  try {
    const std::string file = anthrob::required(settings, "model", "the path of a model file");
    const anthrob::TendonDisplay display(anthrob::load_robot_model(file), nh);
    ros::spin();
  } catch (const anthrob::BadInput& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM("tendons: " << error.what());
    return 1;
  }
  return 0;
}
