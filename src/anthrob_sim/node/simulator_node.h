#pragma once

#include <anthrob_msgs/Gains.h>
#include <anthrob_msgs/MuscleCommand.h>
#include <anthrob_msgs/SetRate.h>
#include <anthrob_msgs/SetState.h>
#include <anthrob_msgs/Step.h>
#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Empty.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/transform_broadcaster.h>

#include <chrono>
#include <map>
#include <optional>
#include <string>

#include "anthrob_ecu/supervisor.h"
#include "anthrob_ros/ball_joint_publisher.h"
#include "anthrob_ros/descriptor_watch.h"
#include "anthrob_ros/registration_watch.h"
#include "anthrob_sim/simulation.h"
#include "external_pushes.h"
#include "interrupts.h"
#include "quantity_topic.h"
#include "report/solved_path.h"
#include "simulation/driven_joints.h"
#include "snapshots.h"
#include "surface_display.h"
#include "tendon_publisher.h"

namespace anthrob {

/// The ROS contract around a simulation: topics, services, time. Commands and services are served
/// between two cycles, so a command takes effect at a cycle's start and a service answers when it
/// is done. Stops have a thread of their own, as the driver's, and take effect between two steps:
/// no message and no call can delay them.
class SimulatorNode {
 public:
  /// Real-time factor below which one cycle takes many seconds.
  static constexpr double kSlowest = 0.001;

  struct Options {
    double rate = 1.0;          ///< real-time factor; 0: as fast as possible
    double state_rate = 500.0;  ///< [Hz of simulated time] states and clock
    double marker_rate = 25.0;  ///< [Hz of wall time]
    double tf_rate = 100.0;     ///< [Hz of simulated time]
    bool paused = false;
    /// Cameras measure the ball joints: their own positions go to sim/ then.
    bool motion_capture = false;
    std::vector<std::string> quantities;  ///< on sim/quantities from the start
    std::string hint;  ///< said once it publishes
    ecu::Supervisor::Options supervisor;
  };

  SimulatorNode(std::shared_ptr<const RobotModel> model, const Options& options,
                ros::NodeHandle nh);

  /// Until ROS shuts down.
  void run();

 private:
  using Clock = std::chrono::steady_clock;

  void on_command(const anthrob_msgs::MuscleCommand& command, const std::string& sender);
  void on_effort(const sensor_msgs::JointState& command, const std::string& sender);
  /// Of a command that sim/step may wait for.
  void note_stamp(const ros::Time& commanded);
  void warn_of_refusal(const char* topic, const std::string& reason);
  void advertise_topics();
  void subscribe_to_commands();
  void offer_services();
  /// Puts a request to muscles and driven joints.
  template <typename Request>
  void supervise(Request request, std_srvs::Trigger::Response* response = nullptr);
  /// The same between two steps, for the thread of stops.
  template <typename Request>
  void supervise_between_steps(Request request, std_srvs::Trigger::Response& response);
  /// An emergency stop that nobody asked for.
  void stop_for(const std::string& why);
  bool on_enable(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  /// Nothing is lost here that it could find: moves nothing. As on the robot it wants enabled
  /// motors, and from then on commands are watched, whether some came before or none.
  bool on_home(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool on_disable(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool on_emergency_stop(std_srvs::Trigger::Request& request,
                         std_srvs::Trigger::Response& response);
  bool on_gains(anthrob_msgs::Gains::Request& request, anthrob_msgs::Gains::Response& response);
  bool on_clear_faults(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool on_pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  bool on_step(anthrob_msgs::Step::Request& request, anthrob_msgs::Step::Response& response);
  bool on_set_rate(anthrob_msgs::SetRate::Request& request,
                   anthrob_msgs::SetRate::Response& response);
  bool on_reset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool on_set_state(anthrob_msgs::SetState::Request& request,
                    anthrob_msgs::SetState::Response& response);

  /// Serves commands until one stamped `stamp` or later has been in; false if none comes.
  bool wait_for_command(const ros::Time& stamp);
  /// Stops what nobody commands any more.
  void watch_commands();
  /// @return false if the numbers broke down; the simulation is paused then
  bool advance(int steps);
  void apply_supervision();
  /// At least one [s of simulated time].
  int steps_in(double time) const;
  void hear();
  void cycle();
  /// So that tf shows what is placed next.
  void skip_to_new_instant();
  /// What was saved, at an instant of its own.
  void restore(const Snapshot& snapshot);
  /// Rest, at an instant of its own; what failed is forgotten.
  void start_anew();
  void publish(bool all);
  void publish_clock();
  void repeat_clock();
  void publish_diagnostics();
  diagnostic_msgs::DiagnosticStatus own_status(double elapsed) const;
  diagnostic_msgs::DiagnosticStatus path_status() const;
  void pace();
  ros::Time stamp() const;

  Options options_;
  Simulation sim_;
  ecu::Supervisor supervisor_;  ///< of muscles
  DrivenJoints driven_;
  std::vector<ecu::MuscleReference> accepted_;
  int steps_per_state_, steps_per_cycle_;
  int steps_to_state_;  ///< until the next one is published
  int steps_done_ = 0;  ///< in the last cycle
  std::uint64_t states_ = 0;
  std::string failure_;  ///< why the simulation stands still; empty if it does not

  ros::NodeHandle nh_;
  ros::CallbackQueue command_queue_;  ///< of its own, so that sim/step can wait for a command
  ros::CallbackQueue stop_queue_;
  Interrupts interrupts_;
  std::optional<std::string> stopped_for_;  ///< why, if nobody asked for the stop that holds
  ros::Time last_command_stamp_;
  std::map<std::string, ros::WallTime> last_warnings_;  ///< by topic
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  ros::Publisher clock_, muscles_, joints_, muscle_paths_, touch_, solved_paths_, moment_arms_,
      diagnostics_;
  BallJointPublisher spherical_joints_;
  SurfaceDisplay surfaces_;
  ExternalPushes pushes_;
  QuantityTopic quantities_;
  Snapshots snapshots_;
  TendonPublisher tendons_;
  tf2_ros::TransformBroadcaster transforms_;

  Clock::time_point deadline_, report_time_, marker_time_, clock_time_;
  double report_sim_time_ = 0.0;
  int late_cycles_ = 0;
  Penetration deepest_;  ///< of a path point into a surface since the last report
  // Last, so that their threads end first.
  std::optional<RegistrationWatch> registration_;
  std::optional<DescriptorWatch> descriptors_;
};

}  // namespace anthrob
