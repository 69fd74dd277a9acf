// Moves the robot through a list of postures by actuator position references that are derived from
// the model, without joint feedback. To the first posture the references move slowly, from where
// the motors are.
#include <ros/ros.h>

#include <optional>
#include <stdexcept>

#include "anthrob_control/approach.h"
#include "anthrob_control/posture_sequence.h"
#include "anthrob_control/ros/reference_watch.h"
#include "anthrob_control/ros/robot_link.h"
#include "anthrob_ros/parameters.h"
#include "anthrob_ros/run_node.h"

namespace {

/// Commands are renewed faster than they time out.
constexpr double kCommandRate = 50.0;  // [Hz]
constexpr int kUnheeded = 25;          // 0.5 s of commands: motors may start with the first of them

/// Ends the player when motors are off, so that the next enable does not resume a posture. It
/// counts commands, not time: after a pause of the player itself, its next command may start the
/// motors again.
/// @param unheeded commands in a row while a motor was off
/// @throws std::runtime_error naming a motor that is off
void check_motors(const anthrob::RobotLink& link, int& unheeded) {
  const std::optional<std::string> off = link.state().disabled_muscle();
  unheeded = off ? unheeded + 1 : 0;
  if (off && unheeded > kUnheeded) {
    throw std::runtime_error("the motor of " + *off +
                             " is not enabled; call enable, then start the player again");
  }
}

/// Ends the player when the robot is gone.
class Silence {
 public:
  /// @return whether all muscles are measured now
  /// @throws std::runtime_error naming a muscle that was not measured for long
  bool check(const anthrob::RobotLink& link) {
    const std::optional<std::string> silence =
        link.state().complaint_of_muscles(link.now().toSec(), kStale);
    const ros::WallTime now = ros::WallTime::now();
    if (!silence) heard_ = now;
    // By the wall's clock: simulated time may outrun the messages.
    if (silence && (now - heard_).toSec() > kStale)
      throw std::runtime_error("the robot is silent: " + *silence);
    return !silence;
  }

 private:
  static constexpr double kStale = 0.5;  // [s]
  ros::WallTime heard_ = ros::WallTime::now();
};

/// Until there is a robot.
/// @return false when ROS shuts down
bool wait_for_states(anthrob::RobotLink& link) {
  bool seen = false;
  link.on_muscles = [&](const anthrob_msgs::MuscleStates&) { seen = true; };
  while (!seen) {
    if (!link.wait()) return false;
  }
  link.on_muscles = nullptr;
  return true;
}

/// @return false when ROS shuts down
bool play(ros::NodeHandle& nh, ros::NodeHandle& settings) {
  const auto model = anthrob::load_robot_model(anthrob::required_model(settings));
  const auto sequence = anthrob::PostureSequence::load(
      anthrob::required(settings, "postures", "a posture file"), *model);
  double speed = anthrob::Approach::kSpeed;
  anthrob::take(settings, "approach_speed", anthrob::positive_number_of, speed);
  double simulator_rate = 1.0;
  anthrob::take(settings, "simulator_rate", anthrob::real_time_factor_of, simulator_rate);
  const auto references = sequence.references(model);
  anthrob::Approach approach(model, speed);
  const std::string first =
      "moving slowly to the posture " + sequence.steps.front().name + " first, if it is far away";

  anthrob::RobotLink::Options options;
  options.period = 1.0 / kCommandRate;
  anthrob::RobotLink link(nh, model, options);
  if (!wait_for_states(link)) return false;
  ros::Time end;
  int unheeded = 0;
  Silence silence;
  anthrob::ReferenceWatch reference_watch;
  ROS_INFO_STREAM(first);
  for (std::size_t i = 0; i < sequence.steps.size();) {
    if (link.time_jumped()) {
      ROS_WARN_STREAM("time jumped back: starting again, " << first);
      approach.begin();
      i = 0;
      end = ros::Time();
      unheeded = 0;
    }
    if (end.isZero() && approach.arrived()) {
      ROS_INFO_STREAM("posture " << i + 1 << " of " << sequence.steps.size() << ": "
                                 << sequence.steps[i].name);
      end = link.now() + ros::Duration(sequence.steps[i].hold);
    }
    if (!end.isZero() && link.now() >= end) {
      ++i;
      end = ros::Time();
      continue;
    }
    const bool measured = silence.check(link);
    check_motors(link, unheeded);
    reference_watch.look(link.state(), link.now(), false);
    // Motors that were off begin where they are, if only for a moment.
    if (link.take_disabled()) approach.begin();
    if (measured || approach.begun()) {
      const std::vector<double>& reference =
          approach.step(references[i], link.state().measurement(), link.dt());
      link.send(anthrob::make_command(*model, anthrob::ecu::Mode::kPosition, reference));
    }
    if (!link.wait()) return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  anthrob::NodeInfo info;
  info.name = "posture_player";
  info.ends_by_itself = true;
  info.role = anthrob::NodeInfo::Role::kCommander;
  info.purpose = "Moves the robot through the postures of a file.";
  info.parameters = {
      {"model", "model file, or a name such as anthrob/II (required)"},
      {"postures", "path of a posture file (required)"},
      {"approach_speed", "[rad/s] of the motors on the way to the first posture (default: 1)"},
      {"simulator_rate",
       "real-time factor of the simulator that is commanded, only checked: above 0 and at most 1, "
       "since otherwise measurements come too late (default: 1)"},
  };
  return anthrob::run_node(argc, argv, info, [](ros::NodeHandle& nh, ros::NodeHandle& settings) {
    return play(nh, settings) ? 0 : 130;
  });
}
