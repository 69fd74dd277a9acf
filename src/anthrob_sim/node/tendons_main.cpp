#include <ros/ros.h>

#include "anthrob_core/errors.h"
#include "anthrob_ros/parameters.h"
#include "anthrob_ros/run_node.h"
#include "anthrob_ros/single_backend.h"
#include "tendon_display.h"

int main(int argc, char** argv) {
  anthrob::NodeInfo info;
  info.name = "tendons";
  info.purpose = "Publishes the tendons of a robot as markers for RViz.";
  info.parameters = {{"model", "model file, or a name such as anthrob/II (required)"},
                     {"joint_tf", "publish ball joints in tf, too (default: false)"},
                     {"back_end", "name of the only back end that may be shown (default: any)"}};
  return anthrob::run_node(argc, argv, info, [](ros::NodeHandle& nh, ros::NodeHandle& settings) {
    const std::string file = anthrob::required_model(settings);
    std::string back_end;
    anthrob::take(settings, "back_end", anthrob::text_of, back_end);
    anthrob::refuse_other_back_ends(nh, back_end);
    bool joint_tf = false;
    anthrob::take(settings, "joint_tf", anthrob::truth_of, joint_tf);
    const anthrob::TendonDisplay display(anthrob::load_robot_model(file), nh, joint_tf);
    ros::spin();
    return 0;
  });
}
