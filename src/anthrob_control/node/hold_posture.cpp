// Puts a running simulator into one posture of a posture file, at equilibrium, and commands the
// references that hold it. For pictures and for trying things out.
#include <anthrob_msgs/MuscleStates.h>
#include <anthrob_msgs/SetState.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <algorithm>
#include <stdexcept>

#include "anthrob_control/posture_sequence.h"
#include "anthrob_control/ros/robot_link.h"
#include "anthrob_ros/parameters.h"
#include "anthrob_ros/run_node.h"

namespace {

anthrob_msgs::SetState state_of(const anthrob::RobotModel& model, const std::vector<double>& q,
                                const std::vector<double>& positions) {
  anthrob_msgs::SetState state;
  for (const anthrob::JointModel& joint : model.skeleton->joints) {
    const double* p = &q[joint.position_offset];
    if (joint.type == anthrob::JointType::kBall) {
      geometry_msgs::Quaternion turn;
      turn.w = p[0], turn.x = p[1], turn.y = p[2], turn.z = p[3];
      state.request.ball_joint_name.push_back(joint.name);
      state.request.ball_joint_orientation.push_back(turn);
    } else {
      state.request.joint_name.push_back(joint.name);
      state.request.joint_position.push_back(p[0]);
    }
  }
  for (std::size_t m = 0; m < model.muscles.size(); ++m) {
    state.request.muscle_name.push_back(model.muscles[m].name);
    state.request.muscle_position.push_back(positions[m]);
  }
  return state;
}

/// @return whether the simulator is there
bool wait_for_simulator(const ros::NodeHandle& nh) {
  constexpr double kSilence = 3.0;  // [s]
  const std::string service = nh.resolveName("sim/set_state");
  const ros::WallTime begin = ros::WallTime::now();
  for (bool told = false; ros::ok(); ros::WallDuration(0.05).sleep()) {
    if (ros::service::exists(service, false)) return true;
    if (told || (ros::WallTime::now() - begin).toSec() < kSilence) continue;
    told = true;
    ROS_WARN_STREAM("waiting for " << service
                                   << ", which nobody offers: is the simulator running? Start this "
                                      "node in the robot's namespace, e.g. __ns:=/anthrob");
  }
  return false;
}

/// A simulator that does not follow commands would let go of the posture at once. One that says
/// nothing, such as a paused one, is believed.
/// @throws std::runtime_error if its motors are not enabled
void require_enabled(ros::NodeHandle& nh, const anthrob::RobotModel& model) {
  constexpr double kPatience = 3.0;  // [s] until it has enabled itself
  using anthrob_msgs::MuscleStates;
  std::string disabled;
  const auto see = [&](const MuscleStates& states) {
    disabled.clear();
    for (std::size_t i = 0; i < std::min(states.name.size(), states.ecu_state.size()); ++i) {
      const int muscle = model.find_muscle(states.name[i]);
      if (muscle < 0 || !model.muscles[muscle].has_controller) continue;
      if (states.ecu_state[i] != MuscleStates::ENABLED) disabled = states.name[i];
    }
  };
  bool heard = false;
  const auto subscriber = nh.subscribe<MuscleStates>(
      "muscle_states", 1,
      [&](const MuscleStates::ConstPtr& states) { heard = true, see(*states); });
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kPatience);
  while (ros::ok() && ros::WallTime::now() < end) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.05));
    if (heard && disabled.empty()) return;
  }
  if (ros::ok() && heard)
    throw std::runtime_error("muscle " + disabled + " is not enabled; call enable first");
}

/// @return whether the posture was commanded
bool hold(ros::NodeHandle& nh, ros::NodeHandle& settings) {
  const std::string wanted = anthrob::required(settings, "posture", "the name of a posture");
  const auto model = anthrob::load_robot_model(anthrob::required_model(settings));
  const auto sequence = anthrob::PostureSequence::load(
      anthrob::required(settings, "postures", "a posture file"), *model);
  const auto step = std::find_if(sequence.steps.begin(), sequence.steps.end(),
                                 [&](const anthrob::PostureStep& s) { return s.name == wanted; });
  if (step == sequence.steps.end())
    throw anthrob::BadInput("parameter ~posture: '" + wanted +
                            "': expected the name of a posture in the file of ~postures");
  if (!step->reference.empty()) {
    throw anthrob::BadInput("parameter ~posture: '" + wanted +
                            "': has references; expected a posture that has joints instead");
  }
  anthrob::refuse_without_controllers(*model);
  anthrob::Simulation scratch(model);
  const anthrob::Equilibrium equilibrium =
      anthrob::find_equilibrium(scratch, step->q, sequence.options);
  anthrob::refuse_if_not_holdable(wanted, *model, equilibrium);
  anthrob::refuse_beyond_limits(wanted, *model, equilibrium.reference);

  ros::Publisher commands = nh.advertise<anthrob_msgs::MuscleCommand>("muscle_command", 1);
  if (!wait_for_simulator(nh)) return false;
  require_enabled(nh, *model);
  auto state = state_of(*model, step->q, equilibrium.position);
  const bool answered = ros::service::call("sim/set_state", state);
  if (!ros::ok()) return false;
  if (!answered)
    throw std::runtime_error("sim/set_state: no answer: is the simulator still running?");
  if (!state.response.success) throw anthrob::BadInput("sim/set_state: " + state.response.message);
  while (ros::ok() && commands.getNumSubscribers() == 0) ros::WallDuration(0.05).sleep();
  if (!ros::ok()) return false;
  commands.publish(
      anthrob::make_command(*model, anthrob::ecu::Mode::kPosition, equilibrium.reference));
  ros::WallDuration(0.3).sleep();  // until it has gone out
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  anthrob::NodeInfo info;
  info.name = "hold_posture";
  info.ends_by_itself = true;
  info.role = anthrob::NodeInfo::Role::kCommander;
  info.purpose =
      "Puts a running simulator into one posture of a file, at equilibrium, and commands it once.";
  info.options = ros::init_options::AnonymousName;
  info.parameters = {
      {"model", "model file, or a name such as anthrob/II (required)"},
      {"postures", "path of a posture file (required)"},
      {"posture", "name of a posture in that file; must be given by joints (required)"},
  };
  return anthrob::run_node(argc, argv, info, [](ros::NodeHandle& nh, ros::NodeHandle& settings) {
    return hold(nh, settings) ? 0 : 130;
  });
}
