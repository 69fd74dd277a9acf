#pragma once

#include <anthrob_msgs/ExternalWrenches.h>
#include <anthrob_msgs/Gap.h>
#include <anthrob_msgs/MuscleStates.h>
#include <anthrob_msgs/SphericalJointStates.h>
#include <anthrob_msgs/TakeModel.h>
#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <tf2_ros/transform_broadcaster.h>

#include <memory>
#include <string>
#include <vector>

#include "sample_reader.h"
#include "twin/gap_watch.h"
#include "twin/twins.h"

namespace anthrob {

/// The ROS contract around the twins. Listens to a robot, and publishes nothing that moves it.
class TwinNode {
 public:
  struct Options {
    twin::TwinOptions twins;
    twin::Feed feed = twin::Feed::kCommands;  ///< of the twin that is shown
    double rate = 100.0;                      ///< [Hz of measured time] of the twin's states
    std::string floors;                       ///< file; empty: all are learned
  };

  /// @throws BadInput for a wrong file of floors
  TwinNode(std::shared_ptr<const RobotModel> model, const Options& options, ros::NodeHandle nh);

  /// Until ROS shuts down.
  void run();

 private:
  /// Begins anew with a model. @throws BadInput for a wrong file of floors
  void begin_with(const RobotModel& model);
  bool serve_take_model(const anthrob_msgs::TakeModel::Request& request,
                        anthrob_msgs::TakeModel::Response& response);
  template <class Message>
  void hear(const Message& message, twin::Topic topic);
  void take(const twin::MuscleSample& sample, twin::Topic) { twins_->hear(sample); }
  void take(const twin::JointSample& sample, twin::Topic topic) { twins_->hear(sample, topic); }
  void hear_pushes(const anthrob_msgs::ExternalWrenches& message);
  void advance();
  void tell_starts();
  void publish_states();
  void publish_ghost(const ros::Time& stamp);
  void publish_gap();
  void publish_diagnostics();
  diagnostic_msgs::DiagnosticStatus own_status() const;
  std::vector<diagnostic_msgs::DiagnosticStatus> gap_statuses() const;

  Options options_;
  std::unique_ptr<twin::Twins> twins_;
  std::unique_ptr<twin::GapWatch> watch_;
  std::unique_ptr<SampleReader> reader_;
  ros::NodeHandle nh_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  ros::Publisher muscles_, joints_, balls_, gap_, diagnostics_;
  tf2_ros::TransformBroadcaster transforms_;
  ros::WallTimer timer_;
  Nanoseconds next_states_ = 0, next_ghost_ = 0;  ///< when they are due
  ros::WallTime heard_;                           ///< zero: nothing was
  long malformed_ = 0;
  long starts_ = 0;  ///< of the twin that is shown
};

}  // namespace anthrob
