#pragma once

#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <memory>
#include <optional>
#include <string>

#include "anthrob_control/approach.h"
#include "anthrob_control/ros/reference_watch.h"
#include "anthrob_control/ros/robot_link.h"
#include "measured_names.h"
#include "recording_store.h"
#include "visit.h"
#include "visit_bags.h"

namespace anthrob {

/// Carries out a protocol on a robot, simulated or real. Uses only the topics and services that
/// both have.
class Recorder {
 public:
  /// @param robot_model model file of the simulated robot; empty: a real or an unknown one
  Recorder(ros::NodeHandle nh, ros::NodeHandle own, std::shared_ptr<const RobotModel> model,
           const Protocol& protocol, const std::string& folder, const RobotLink::Options& options,
           double approach_speed, const std::string& robot_model);

  /// @return whether everything was recorded; false if ROS shut down first
  /// @throws std::runtime_error if a posture cannot be recorded
  bool run();

 private:
  enum class Result { kDone, kAgain, kShutdown };

  Result record(const Protocol::Target& target, int repeat);
  /// Whether the robot has reached the posture with which the first visit begins.
  bool is_there() const {
    return approach_.arrived() || protocol_.kind == Protocol::Kind::kZeroGravity;
  }
  /// Whether the robot has begun to follow.
  bool is_underway(const Visit& visit) const;
  /// One instant of a visit. @return false if ROS shut down
  bool advance(Visit& visit, const Protocol::Target& target);
  /// Sends the current order; repeats it for a while if it is refused.
  void carry_out(Visit& visit, const Protocol::Target& target);
  /// @throws std::runtime_error if motors are off: the posture is then no equilibrium of the
  /// muscles
  void check_motors();
  /// @return why the controller refused; none if it did not
  std::optional<std::string> follow(const Visit::Order& order, const Protocol::Target& target);
  void send_references(const std::vector<double>& references);
  std::optional<std::string> call_controller(Visit::Aim aim, const Protocol::Target& target);
  void store(const Visit& visit, const Protocol::Target& target, int repeat);
  void write_files(const Visit& visit, const Protocol::Target& target, int repeat);
  void drop();
  DatasetMeta describe(const Visit& visit, const Protocol::Target& target, int repeat,
                       int recording) const;
  void report(const std::string& name, const Visit& visit);
  /// Records a topic that is not measured.
  template <class Message>
  void listen(const char* topic);
  bool on_sample(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

  ros::NodeHandle nh_;
  std::shared_ptr<const RobotModel> model_;
  Protocol protocol_;
  RecordingStore store_;
  VisitBags bags_;
  RobotLink link_;
  MeasuredNames measured_names_;
  bool lock_step_;
  Approach approach_;
  std::vector<ros::Subscriber> subscribers_;
  ros::ServiceServer sample_;
  std::optional<std::string> trouble_;  ///< why the last visit is not stored
  Visit* visit_ = nullptr;
  bool aimed_ = false;
  Visit::Aim aim_ = Visit::Aim::kRest;
  Visit::Order order_{Visit::Aim::kRest, 0};
  bool obeyed_ = false;          ///< whether any order has been followed
  ros::WallTime refused_since_;  ///< zero: the last order is followed
  ros::WallTime asked_;
  ros::Time sent_, driven_;
  ReferenceWatch reference_watch_;
  int done_ = 0, recorded_ = 0;
  ros::WallTime start_ = ros::WallTime::now(), heard_ = start_;
};

}  // namespace anthrob
