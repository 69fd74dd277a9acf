// The least controller there can be: waits for a robot, commands 0 V once, ends.
#include <cstdio>
#include <exception>

#include "anthrob_control/ros/robot_link.h"

int run(const char* model_file) {
  const auto model = anthrob::load_robot_model(model_file);
  anthrob::RobotLink link(ros::NodeHandle(), model, {});
  const std::vector<double> volts(model->muscles.size(), 0.0);
  while (link.wait()) {
    if (link.state().complaint(link.now().toSec(), 0.1)) continue;
    link.send(anthrob::make_command(*model, anthrob::ecu::Mode::kVoltage, volts));
    std::printf("commanded %zu muscles\n", volts.size());
    return 0;
  }
  return 1;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "controller");
  if (argc != 2) {
    std::fprintf(stderr, "controller: expected the path of a model file\n");
    return 2;
  }
  try {
    return run(argv[1]);
  } catch (const std::exception& error) {  // a file that is no model, a simulator that has ended
    std::fprintf(stderr, "controller: %s\n", error.what());
    return 1;
  }
}
