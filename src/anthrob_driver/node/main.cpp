#include <ros/ros.h>

#include "anthrob_config/errors.h"
#include "driver_node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "driver");
  ros::NodeHandle nh, settings("~");
  try {
    std::string file, can;
    if (!settings.getParam("hardware", file)) {
      throw anthrob::BadInput("parameter ~hardware: missing; expected the path of hardware.yaml");
    }
    settings.param<std::string>("can", can, "can0");
    bool hand = false;
    settings.param("hand", hand, hand);
    anthrob::driver::DriverThread::Options options;
    settings.param("rate", options.driver.rate, options.driver.rate);
    settings.param("command_timeout", options.driver.command_timeout,
                   options.driver.command_timeout);
    settings.param("realtime", options.realtime, options.realtime);
    settings.param("pace", options.pace, options.pace);
    const bool in_memory = can.rfind("vcan", 0) == 0;
    if (!(options.pace > 0.0 && options.pace <= 1.0) || (options.pace < 1.0 && !in_memory)) {
      throw anthrob::BadInput("parameter ~pace: expected 1, or a number in (0, 1] on a vcan");
    }
    anthrob::driver::DriverNode node(anthrob::driver::load_hardware(file, hand), options, can, nh);
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
    ROS_FATAL_STREAM("driver: " << error.what());
    return 1;
  }
  return 0;
}
