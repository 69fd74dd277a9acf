#include <ros/ros.h>

#include "anthrob_ros/parameters.h"
#include "anthrob_ros/run_node.h"
#include "anthrob_ros/single_backend.h"
#include "anthrob_sim/core/errors.h"
#include "simulator_node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "simulator");
  if (anthrob::name_is_taken()) return 2;
  return anthrob::run_node("simulator", [](ros::NodeHandle& nh, ros::NodeHandle& settings) {
    using namespace anthrob;
    const std::string file = required(settings, "model", "the path of a model file");
    LoadOptions load;
    take(settings, "step", number_of, load.step);
    if (!(load.step > 0.0 && load.step <= kMaximumStep)) {
      throw BadInput("parameter ~step: " + std::to_string(load.step) +
                     ": expected a number in (0, 0.1] [s]");
    }
    SimulatorNode::Options options;
    take(settings, "rate", nonnegative_number_of, options.rate);
    take(settings, "state_rate", number_of, options.state_rate);
    take(settings, "paused", truth_of, options.paused);
    options.supervisor.auto_enable = true;
    take(settings, "auto_enable", truth_of, options.supervisor.auto_enable);
    take(settings, "command_timeout", nonnegative_number_of, options.supervisor.command_timeout);
    if (!(options.state_rate >= 1.0))
      throw BadInput("parameter ~state_rate: " + std::to_string(options.state_rate) +
                     ": expected a number >= 1 [Hz]");
    const auto model = load_robot_model(file, load);
    for (const std::string& remark : model->remarks) ROS_WARN_STREAM(remark);
    const ros::Publisher claim = claim_robot(nh);
    SimulatorNode node(model, options, nh);
    node.run();
    return 0;
  });
}
