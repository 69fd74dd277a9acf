#pragma once

#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <memory>
#include <optional>

#include "anthrob_ros/ball_joint_publisher.h"
#include "pipeline/tracker.h"
#include "render/setup.h"
#include "source/frame_source.h"
#include "status.h"
#include "topic_input.h"

namespace anthrob {
namespace mocap {

/// The pipeline between images and ROS: ball joints as the simulator publishes them, target poses,
/// tf, markers, a debug image, diagnostics.
class MocapNode {
 public:
  struct Options {
    PipelineMode mode = PipelineMode::kSequential;
    std::string camera_frame = "mocap_camera";
    double sync_tolerance = 0.0;  ///< [s] between stamps of image topics
    bool joint_tf = false;        ///< publish links of joints; a simulator does so itself
    bool recorded = false;        ///< a source that ends: every result is published, however late
    TrackerOptions tracker;
  };

  MocapNode(ros::NodeHandle nh, const StereoRig& rig, const TargetSet& set,
            const std::optional<Setup>& setup, const Options& options);
  ~MocapNode();

  /// Tracks image topics until ROS shuts down.
  void run();
  /// Tracks what a source delivers, until it ends or ROS shuts down. With a recorded source it
  /// first waits for a subscriber, for 5 s at most.
  void run(FrameSource& source);
  /// Logs and counts an image that could not be used.
  void refuse(const std::string& why);

 private:
  void advertise();
  void publish_camera_frame();
  bool heard() const;
  void wait_for_listeners() const;
  void on_pair(const TimedImage pair[2]);
  void take(std::unique_ptr<StereoFrame> frame);
  void publish(const StereoFrame& frame);
  std_msgs::Header joint_header(const ros::Time& stamp, std::size_t joint) const;
  void publish_transforms(const StereoFrame& frame, const std_msgs::Header& header);
  void publish_pictures(const StereoFrame& frame, const std_msgs::Header& header);
  void publish_diagnostics(const std::optional<std::string>& trouble,
                           const Pairing::Counts& images);
  void check_size(const StereoFrame& frame) const;
  void check_stamp(const StereoFrame& frame) const;
  void report_on(TopicInput& input);
  void log_findings() const;
  void log_missing() const;

  ros::NodeHandle nh_, images_;
  StereoRig rig_;
  TargetSet set_;
  std::optional<Setup> setup_;
  Options options_;

  BallJointPublisher joints_;
  ros::Publisher markers_, debug_, diagnostics_;
  std::vector<ros::Publisher> target_poses_, joint_estimates_;
  tf2_ros::TransformBroadcaster transforms_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  ros::WallTime last_markers_, last_debug_, last_report_, last_told_;
  ros::Time last_report_time_, last_asked_;
  std::optional<std::string> last_trouble_;
  Pairing::Counts last_counts_;

  Status status_;
  Health recording_;  ///< of all pictures of a recorded source
  std::uint64_t index_ = 0, accepted_ = 0;
  std::string untold_, last_refusal_;  ///< the former: not logged yet
  Pipeline pipeline_;                  ///< last: its threads use all of the above
};

}  // namespace mocap
}  // namespace anthrob
