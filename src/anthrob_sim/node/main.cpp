#include <ros/ros.h>

#include "anthrob_sim/core/errors.h"
#include "simulator_node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "simulator");
  ros::NodeHandle nh, settings("~");
  try {
    std::string file;
    if (!settings.getParam("model", file)) {
      throw anthrob::BadInput("parameter ~model: missing; expected the path of a model file");
    }
    anthrob::LoadOptions load;
    settings.param("step", load.step, load.step);
    anthrob::SimulatorNode::Options options;
    settings.param("rate", options.rate, options.rate);
    settings.param("state_rate", options.state_rate, options.state_rate);
    settings.param("paused", options.paused, options.paused);
    settings.param("auto_enable", options.supervisor.auto_enable, true);
    settings.param("command_timeout", options.supervisor.command_timeout, 0.5);
    if (!(options.rate >= 0.0)) throw anthrob::BadInput("parameter ~rate: expected a number >= 0");
    if (!(options.state_rate >= 1.0))
      throw anthrob::BadInput("parameter ~state_rate: expected a number >= 1 [Hz]");
    if (!(options.supervisor.command_timeout >= 0.0)) {
      throw anthrob::BadInput("parameter ~command_timeout: expected a number >= 0 [s]");
    }
    const auto model = anthrob::load_robot_model(file, load);
    for (const std::string& remark : model->remarks) ROS_WARN_STREAM(remark);
    anthrob::SimulatorNode node(model, options, nh);
    const std::string other = node.other_backend();
    if (!other.empty()) {
      throw anthrob::BadInput(nh.resolveName("muscle_states") + ": " + other +
                              " publishes it already; stop that back end first");
    }
    node.run();
  } catch (const anthrob::BadInput& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM("simulator: " << error.what());
    return 1;
  }
  return 0;
}
