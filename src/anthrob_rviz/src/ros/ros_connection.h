#pragma once

#include <anthrob_msgs/MomentArms.h>
#include <anthrob_msgs/MuscleStates.h>
#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "robot_connection.h"

namespace anthrob {

/// A robot over ROS. Messages wait in a queue of its own until look(), so that they are served by
/// the GUI's thread, also while RViz's own queue is busy with pictures.
class RosConnection final : public RobotConnection {
 public:
  enum class Role { kWatcher, kCommander };  ///< only a commander advertises muscle_command

  explicit RosConnection(Role role);

  void connect(const std::string& robot) override;
  News look() override;
  void send(const std::vector<Reference>& references) override;
  bool call(const ServiceRequest& request) override;
  void shout_stop() override;
  void cancel(const std::string& job) override;
  bool simulated() const override;
  ReferenceLimits limits() const override;

 private:
  /// What the master is asked now and then, by a thread, because it may not answer.
  struct Surroundings;

  void subscribe();
  void survey(double now);
  template <class Feedback, class Result>
  void subscribe_job(const std::string& job);
  void hear_arms(const anthrob_msgs::MomentArms& message);
  void hear_muscles(const anthrob_msgs::MuscleStates& message);
  void hear_diagnostics(const diagnostic_msgs::DiagnosticArray& message);

  Role role_;
  ros::CallbackQueue queue_;
  ros::NodeHandle nh_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Subscriber arms_;
  ros::Publisher commands_, stop_;
  std::map<std::string, ros::Publisher> cancels_;  ///< by job
  News news_;
  TimedCalls calls_;
  std::shared_ptr<Surroundings> surroundings_;
  double next_survey_ = 0.0;
};

/// The namespace in which RViz itself runs, as the launch files start it; without one "anthrob".
std::string default_robot();

}  // namespace anthrob
