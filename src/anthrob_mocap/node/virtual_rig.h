#pragma once

#include <image_transport/camera_publisher.h>
#include <image_transport/image_transport.h>
#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include "render/frame_gaps.h"
#include "render/renderer.h"
#include "render/setup.h"

namespace anthrob {
namespace mocap {

/// Publishes what the cameras would see of the targets' links in tf: left/image_raw,
/// right/image_raw and their CameraInfo. An exposure is drawn as soon as tf reaches beyond it, so
/// it comes late by tf's period, and never from extrapolation, nor from interpolation across gaps.
class VirtualRig {
 public:
  VirtualRig(ros::NodeHandle nh, const StereoRig& rig, const TargetSet& set, const Setup& setup);

  /// Until ROS shuts down.
  void run();

 private:
  void expose(const ros::Time& stamp);
  bool scene_at(const ros::Time& time, Scene& scene) const;
  void publish(const ros::Time& stamp, const std::vector<Scene>& instants);
  ros::Time latest();
  void keep_stamps(const tf2_msgs::TFMessage& message);
  std::optional<std::string> frame_with_gap(const std::string& link, const ros::Time& time) const;

  StereoRig rig_;
  TargetSet set_;
  Setup setup_;
  Renderer renderer_;
  std::string missing_ = "nobody publishes tf";  ///< what tf said last
  ros::WallTime last_reach_ = ros::WallTime::now();
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
  FrameGaps gaps_;
  ros::Subscriber stamps_;
  image_transport::ImageTransport transport_;
  image_transport::CameraPublisher publishers_[2];
  Image image_;
  std::uint64_t frame_ = 0;
};

}  // namespace mocap
}  // namespace anthrob
