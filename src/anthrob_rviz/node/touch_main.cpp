#include <ros/ros.h>

#include "anthrob_core/errors.h"
#include "anthrob_ros/parameters.h"
#include "anthrob_ros/run_node.h"
#include "link_pulls.h"
#include "posture_goals.h"
#include "touch/ball_centers.h"

namespace anthrob {
namespace {

constexpr double kLook = 0.02;  // [s] of wall time

Skeleton skeleton_of(const ros::NodeHandle& nh, const ros::NodeHandle& settings) {
  const std::string model = required(settings, "model", "the path of a model file");
  std::string urdf;
  if (!nh.getParam("robot_description", urdf)) {
    throw BadInput("parameter " + nh.resolveName("robot_description") +
                   ": missing; expected the robot's URDF, as sim.launch and robot.launch set it");
  }
  return {urdf, ball_centers(model)};
}

PullSpring spring_of(const ros::NodeHandle& settings) {
  PullSpring spring;
  take(settings, "stiffness", positive_number_of, spring.stiffness);
  take(settings, "damping", nonnegative_number_of, spring.damping);
  take(settings, "force_limit", positive_number_of, spring.limit);
  return spring;
}

int run(ros::NodeHandle& nh, ros::NodeHandle& settings) {
  const Skeleton skeleton = skeleton_of(nh, settings);
  PostureInput input(nh, skeleton);
  LinkPulls pulls(nh, skeleton, input, spring_of(settings));
  PostureGoals goals(nh, skeleton, input);
  input.on_posture = [&] { pulls.renew(); };
  const ros::SteadyTimer timer =
      nh.createSteadyTimer(ros::WallDuration(kLook), [&](const ros::SteadyTimerEvent&) {
        pulls.look();
        goals.look();
      });
  ros::spin();
  return 0;
}

}  // namespace
}  // namespace anthrob

int main(int argc, char** argv) {
  anthrob::NodeInfo info;
  info.name = "touch";
  info.purpose =
      "Lets the mouse in RViz pull the links of a simulated robot, and send a robot to postures.";
  info.parameters = {{"model", "path of a model file, for the centres of ball joints (required)"},
                     {"stiffness", "of the spring between link and mouse [N/m] (default: 100)"},
                     {"damping", "of the grabbed point [Ns/m] (default: 2)"},
                     {"force_limit", "largest force of a pull [N] (default: 30)"}};
  return anthrob::run_node(argc, argv, info, anthrob::run);
}
