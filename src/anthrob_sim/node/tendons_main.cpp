#include <ros/ros.h>

#include "anthrob_ros/parameters.h"
#include "anthrob_ros/run_node.h"
#include "anthrob_sim/core/errors.h"
#include "tendon_display.h"

int main(int argc, char** argv) {
  anthrob::NodeInfo info;
  info.name = "tendons";
  info.purpose = "Publishes the tendons of a robot as markers for RViz.";
  info.parameters = {{"model", "path of a model file (required)"}};
  return anthrob::run_node(argc, argv, info, [](ros::NodeHandle& nh, ros::NodeHandle& settings) {
    const std::string file = anthrob::required(settings, "model", "the path of a model file");
    const anthrob::TendonDisplay display(anthrob::load_robot_model(file), nh);
    ros::spin();
    return 0;
  });
}
