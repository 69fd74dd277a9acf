// A hundred steps of a robot, without ROS.
#include "anthrob_sim/simulation.h"

#include <cstdio>

int main(int, char** argv) {
  anthrob::Simulation simulation(anthrob::load_robot_model(argv[1]));
  simulation.step(100);
  std::printf("%.3f s\n", simulation.time());
}
