#pragma once

#include <anthrob_msgs/MuscleCommand.h>
#include <anthrob_msgs/MuscleStates.h>
#include <anthrob_msgs/SphericalJointStates.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>

#include <functional>
#include <optional>
#include <string>

#include "anthrob_control/robot_state.h"
#include "anthrob_core/publishers.h"
#include "anthrob_ros/clock_wait.h"
#include "anthrob_ros/registration_watch.h"

namespace anthrob {

/// A controller's connection to a robot, simulated or real: its topics and its time. Topic names
/// are relative, so the node must run in the robot's namespace. Example:
///
///   RobotLink link(nh, model, options);
///   while (link.wait()) link.send(my_controller(link.state().measurement(), link.dt()));
///
/// In real time, `wait` returns once every period of ROS time, and warns while ROS time stands
/// still. In lock-step, it lets the simulator take its steps with the command that was sent last,
/// and returns when their results have arrived: a run gives the same bits at any speed.
/// If nobody publishes muscle_states for 5 s of wall time, `wait` warns once.
/// From the first `wait` on it watches that the ROS master knows the node. While it does not,
/// `send` sends nothing: after command_timeout the motors stop.
class RobotLink {
 public:
  struct Options {
    double period = 0.005;   ///< [s] of ROS time
    bool lock_step = false;  ///< drives sim/step; simulator only
    int steps = 5;           ///< simulation steps a period, in lock-step
  };

  RobotLink(ros::NodeHandle nh, std::shared_ptr<const RobotModel> model, const Options& options);

  /// Serves callbacks until the next period. @return false when ROS shuts down
  /// @throws std::runtime_error if the simulator does not step, or no longer runs
  bool wait();
  /// Stamps the command with now() and publishes it, unless there is an obstacle(). @return the
  /// stamp
  ros::Time send(anthrob_msgs::MuscleCommand command);

  /// Why nothing is sent: the ROS master does not know this node, or two nodes publish one
  /// measurement. None if neither is so.
  std::optional<std::string> obstacle() const;
  const RobotState& state() const { return state_; }
  /// As RobotState::take_disabled.
  std::optional<std::string> take_disabled() { return state_.take_disabled(); }
  bool take_jump() { return state_.take_jump(); }
  ros::Time now() const { return now_; }
  /// Time from the previous return of wait to the last one [s]; 0 the first time and when time
  /// jumped back.
  double dt() const { return dt_; }
  /// Whether time jumped back during the last wait; if so, the state was cleared.
  bool time_jumped() const { return jumped_; }

  /// Called with every message, before wait returns; may be empty.
  std::function<void(const anthrob_msgs::MuscleStates&)> on_muscles;
  std::function<void(const sensor_msgs::JointState&)> on_joints;
  std::function<void(const anthrob_msgs::SphericalJointStates&)> on_ball_joints;

 private:
  void note_receipt();
  template <class M>
  ros::Subscriber listen(const std::string& topic, void (RobotLink::*see)(const M&));
  void note_publisher(const std::vector<std::string>& names, const std::string& node);
  void see_muscles(const anthrob_msgs::MuscleStates& message);
  void see_joints(const sensor_msgs::JointState& message);
  void see_ball_joints(const anthrob_msgs::SphericalJointStates& message);
  void look_for_robot();
  bool wait_for_period();
  bool connected() const;
  bool wait_for_simulator();
  bool step_simulator();
  ros::Time call_step();
  bool states_arrive(const ros::Time& stamp, double patience);
  void advance_to(const ros::Time& time);

  ros::NodeHandle nh_;
  Options options_;
  RobotState state_;
  ros::Publisher commands_;
  ros::ServiceClient step_;
  std::vector<ros::Subscriber> subscribers_;  ///< the first one: muscle_states
  ros::Time now_, next_, unstepped_command_;
  anthrob_msgs::MuscleCommand command_;  ///< the last one
  bool command_arrived_ = false;         ///< the simulator has received any command
  ros::SteadyTime started_ = ros::SteadyTime::now();
  bool heard_ = false;   ///< any muscle_states
  bool warned_ = false;  ///< that nobody publishes them
  ClockWait clock_wait_;
  ClockWatch clock_watch_;
  double dt_ = 0.0;
  bool jumped_ = false;
  std::optional<RegistrationWatch> registration_;
  Publishers publishers_;  ///< since publishers_begin_
  ros::SteadyTime publishers_begin_ = ros::SteadyTime::now();
  std::optional<std::string> two_publishers_;
};

/// A command for all muscles that have the mode. It leaves the others out, because with one of them
/// the whole command would be refused.
/// @param references one per muscle of the model, in its order [V, rad, A or N, by mode]
/// @param release with FORCE: muscles without force sensor get VOLTAGE 0 instead of being left out,
///   where they would go on with their last command
anthrob_msgs::MuscleCommand make_command(const RobotModel& model, ecu::Mode mode,
                                         const std::vector<double>& references,
                                         bool release = false);

}  // namespace anthrob
