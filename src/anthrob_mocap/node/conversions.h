#pragma once

#include <anthrob_msgs/SphericalJointStates.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <visualization_msgs/MarkerArray.h>

#include "output/annotation.h"
#include "pipeline/stereo_frame.h"
#include "source/pairing.h"

namespace anthrob {
namespace mocap {

/// @throws BadInput if there is no calibration in it
CameraModel camera_model(const sensor_msgs::CameraInfo& info, Side side);
sensor_msgs::CameraInfo camera_info(const CameraModel& camera);

/// Shares the message's pixels.
/// @throws BadInput unless it is 8-bit grey and has a stamp
TimedImage timed_image(const sensor_msgs::ImageConstPtr& message);

Pose pose(const geometry_msgs::Transform& transform);
geometry_msgs::TransformStamped transform(const Pose& X, const std_msgs::Header& header,
                                          const std::string& child_frame);

/// Joints that are seen and whose velocity is known; what is not seen is absent.
anthrob_msgs::SphericalJointStates spherical_joint_states(const StereoFrame& frame,
                                                          const TargetSet& set,
                                                          const std_msgs::Header& header);
geometry_msgs::PoseWithCovarianceStamped pose_message(const TargetPose& pose,
                                                      const std_msgs::Header& header);
/// Orientation and angular velocity with their covariances, all in the child's axes; no
/// acceleration.
sensor_msgs::Imu joint_message(const JointEstimate& joint, const std_msgs::Header& header);

/// Markers of targets in the target's colour, other points grey.
visualization_msgs::MarkerArray marker_array(const StereoFrame& frame, const TargetSet& set,
                                             const std_msgs::Header& header);

sensor_msgs::Image image_message(const ColourImage& image, const std_msgs::Header& header);

}  // namespace mocap
}  // namespace anthrob
