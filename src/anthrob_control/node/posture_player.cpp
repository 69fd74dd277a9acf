// Visits a list of postures by actuator position references derived from the model: no joint
// feedback.
#include <ros/ros.h>

#include "anthrob_control/posture_sequence.h"
#include "anthrob_control/ros/robot_link.h"
#include "anthrob_ros/parameters.h"

namespace {

/// Commands are renewed faster than they time out.
constexpr double kCommandRate = 50.0;  // [Hz]

void play(ros::NodeHandle& nh, ros::NodeHandle& settings) {
  const auto model =
      anthrob::load_robot_model(anthrob::required(settings, "model", "a model file"));
  const auto sequence = anthrob::PostureSequence::load(
      anthrob::required(settings, "postures", "a posture file"), *model);
  const auto references = sequence.references(model);

  ros::Publisher commands = nh.advertise<anthrob_msgs::MuscleCommand>("muscle_command", 10);
  while (ros::ok() && (commands.getNumSubscribers() == 0 || ros::Time::now().isZero())) {
    ros::WallDuration(0.05).sleep();
  }
  ros::Rate rate(kCommandRate);
  for (std::size_t i = 0; i < sequence.steps.size(); ++i) {
    ROS_INFO_STREAM("posture " << i + 1 << " of " << sequence.steps.size() << ": "
                               << sequence.steps[i].name);
    auto command = anthrob::make_command(*model, anthrob::ecu::Mode::kPosition, references[i]);
    const ros::Time end = ros::Time::now() + ros::Duration(sequence.steps[i].hold);
    while (ros::ok() && ros::Time::now() < end) {
      command.header.stamp = ros::Time::now();
      commands.publish(command);
      rate.sleep();
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "posture_player");
  ros::NodeHandle nh, settings("~");
  try {
    play(nh, settings);
  } catch (const anthrob::BadInput& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 1;
  }
  return 0;
}
