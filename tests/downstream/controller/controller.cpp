// The least controller there can be: waits for a robot, commands 0 V once, ends.
#include <cstdio>

#include "anthrob_control/ros/robot_link.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "controller");
  const auto model = anthrob::load_robot_model(argv[1]);
  anthrob::RobotLink link(ros::NodeHandle(), model, {});
  const std::vector<double> volts(model->muscles.size(), 0.0);
  while (link.wait()) {
    if (!link.state().complaint(link.now().toSec(), 0.1).empty()) continue;
    link.send(anthrob::make_command(*model, anthrob::ecu::Mode::kVoltage, volts));
    std::printf("commanded %zu muscles\n", volts.size());
    return 0;
  }
  return 1;
}
