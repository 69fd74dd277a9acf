#pragma once

#include <anthrob_msgs/Gains.h>
#include <anthrob_msgs/MuscleCommand.h>
#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_msgs/Empty.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <functional>
#include <optional>
#include <vector>

#include "anthrob_ros/descriptor_watch.h"
#include "anthrob_ros/registration_watch.h"
#include "publishing/reading_group.h"
#include "publishing/stamp_clock.h"
#include "request_queue.h"
#include "thread/driver_thread.h"

namespace anthrob {
namespace driver {

/// The ROS contract around the driver: topics, services, diagnostics; the same as the simulator's.
///
/// The bus has a thread of its own, and so have stops, so that nothing can delay them. The calls
/// that wait for the robot (enable, home, clear_faults) run in further threads, and everything else
/// in run(). A call that came in before a stop does not undo it.
class DriverNode {
 public:
  /// @param check_stamps refuse commands whose stamp says that they were not sent just now
  DriverNode(Hardware hardware, const DriverThread::Options& options, const std::string& interface,
             bool check_stamps, ros::NodeHandle nh);

  /// Until ROS shuts down.
  void run();

 private:
  using Trigger = std_srvs::Trigger;

  void on_command(const anthrob_msgs::MuscleCommand& command, const std::string& sender);
  void on_malformed_command(const std::string& why);
  /// [s] of ROS time since `stamp`; 0 if the command has no stamp.
  double command_age(const ros::Time& stamp) const;
  using Outcome = RobotDriver::Outcome;
  /// Polls a pending request. @return whether it is still pending
  using Step = std::function<bool(RobotDriver& driver, double now, Outcome& outcome)>;
  enum class Commands { kTaken, kRefused };
  /// Carries out a service call: `begin`, unless the motors were stopped since the call came in,
  /// then `look` repeatedly while the request is pending.
  /// @param commands that come meanwhile. kRefused also drops commands queued before the reply:
  /// they were meant for the old state
  Outcome carry_out(const Step& begin, const Step& look, Commands commands);
  /// Waits until all commands that have come so far were accepted or refused.
  void pass_commands();
  bool on_enable(Trigger::Request& request, Trigger::Response& response);
  bool on_home(Trigger::Request& request, Trigger::Response& response);
  // The log says who asked for a stop.
  using TriggerEvent = ros::ServiceEvent<Trigger::Request, Trigger::Response>;
  bool on_disable(TriggerEvent& event);
  bool on_emergency_stop(TriggerEvent& event);
  /// Nobody may be able to stop the driver any more.
  void stop_unreachable(Finding finding, const std::string& why);
  void on_stop_message(const ros::MessageEvent<const std_msgs::Empty>& event);
  bool on_clear_faults(Trigger::Request& request, Trigger::Response& response);
  bool on_gains(anthrob_msgs::Gains::Request& request, anthrob_msgs::Gains::Response& response);

  void publish_measurements(double wait);
  /// [s] of the driver's time. @param time, kernel_ns of a Sample
  double age(double time, std::int64_t kernel_ns) const;
  ros::Time ros_now();
  /// When it was measured; none if that is too long ago. @param time, kernel_ns of a Sample
  std::optional<ros::Time> stamp(double time, std::int64_t kernel_ns);
  void publish(const Sample& sample, const ros::Time& stamp);
  /// @param readings of one instant, if any
  void publish_joints(const std::vector<AnalogSample>& readings);
  void publish_touch(const std::vector<AnalogSample>& readings);
  void publish_diagnostics();
  void log_stops();

  DriverThread thread_;
  Hardware hardware_;
  std::string interface_;
  double pace_;
  bool check_stamps_;
  StampClock stamp_clock_;
  ReadingGroup joint_readings_, touch_readings_;
  ros::NodeHandle nh_, stop_nh_, command_nh_, request_nh_;
  ros::CallbackQueue stop_queue_, command_queue_;
  RequestQueue request_queue_;
  int dropping_ = 0;  ///< requests that refuse commands; for the thread of the bus only
  std::atomic<std::uint64_t> command_rounds_{0};  ///< in which run() emptied command_queue_
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  ros::Publisher muscles_, joints_, touch_, diagnostics_;
  double report_time_ = 0.0, look_time_ = 0.0, warning_time_ = -1e9;
  std::uint64_t samples_ = 0, reported_samples_ = 0;
  std::uint64_t logged_stops_ = 0;
  double longest_round_trip_ = 0.0;
  // Last, so that their threads end first.
  std::optional<RegistrationWatch> registration_;
  std::optional<DescriptorWatch> descriptors_;
};

}  // namespace driver
}  // namespace anthrob
