// Visits a list of postures by actuator position references derived from the model: no joint
// feedback.
#include <ros/ros.h>

#include "anthrob_control/posture_sequence.h"
#include "anthrob_control/ros/robot_link.h"
#include "anthrob_ros/clock_wait.h"
#include "anthrob_ros/parameters.h"

namespace {

/// Commands are renewed faster than they time out.
constexpr double kCommandRate = 50.0;  // [Hz]

/// Sends one command for some ROS time from `now` on, which goes on to when that is over.
/// @return false if time jumped back: a bag looped, a simulator was started anew
bool hold(anthrob_msgs::MuscleCommand command, double duration, const ros::Publisher& commands,
          ros::Rate& rate, ros::Time& now) {
  const ros::Time end = now + ros::Duration(duration);
  while (ros::ok() && now < end) {
    command.header.stamp = now;
    commands.publish(command);
    rate.sleep();
    const ros::Time before = now;
    now = ros::Time::now();
    if (now < before) return false;
  }
  return true;
}

void play(ros::NodeHandle& nh, ros::NodeHandle& settings) {
  const auto model =
      anthrob::load_robot_model(anthrob::required(settings, "model", "a model file"));
  const auto sequence = anthrob::PostureSequence::load(
      anthrob::required(settings, "postures", "a posture file"), *model);
  const auto references = sequence.references(model);

  ros::Publisher commands = nh.advertise<anthrob_msgs::MuscleCommand>("muscle_command", 10);
  anthrob::ClockWait clock_wait;
  while (ros::ok() && (commands.getNumSubscribers() == 0 || ros::Time::now().isZero())) {
    if (ros::Time::now().isZero()) clock_wait.look();
    ros::WallDuration(0.05).sleep();
  }
  ros::Rate rate(kCommandRate);
  ros::Time now = ros::Time::now();
  for (std::size_t i = 0; ros::ok() && i < sequence.steps.size();) {
    ROS_INFO_STREAM("posture " << i + 1 << " of " << sequence.steps.size() << ": "
                               << sequence.steps[i].name);
    const auto command =
        anthrob::make_command(*model, anthrob::ecu::Mode::kPosition, references[i]);
    if (hold(command, sequence.steps[i].hold, commands, rate, now)) {
      ++i;
    } else {
      ROS_WARN("time jumped back: begins anew");
      i = 0;
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
