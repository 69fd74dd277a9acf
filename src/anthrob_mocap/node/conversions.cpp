#include "conversions.h"

#include <sensor_msgs/distortion_models.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cmath>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace mocap {

namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

geometry_msgs::Quaternion quaternion_message(const Quat& q) {
  geometry_msgs::Quaternion message;
  message.w = q.w(), message.x = q.x(), message.y = q.y(), message.z = q.z();
  return message;
}

geometry_msgs::Vector3 vector_message(const Vec3& v) {
  geometry_msgs::Vector3 message;
  message.x = v.x(), message.y = v.y(), message.z = v.z();
  return message;
}

geometry_msgs::Point point_message(const Vec3& v) {
  geometry_msgs::Point message;
  message.x = v.x(), message.y = v.y(), message.z = v.z();
  return message;
}

}  // namespace

CameraModel camera_model(const sensor_msgs::CameraInfo& info, Side side) {
  const std::string who = std::string(name(side)) + " camera_info: ";
  if (info.K[0] == 0.0) throw BadInput(who + "the camera is not calibrated");
  const Mat3 K = Eigen::Map<const RowMajor3>(info.K.data());
  if (info.distortion_model != sensor_msgs::distortion_models::PLUMB_BOB &&
      info.distortion_model != sensor_msgs::distortion_models::RATIONAL_POLYNOMIAL) {
    throw BadInput(who + "distortion_model " + info.distortion_model +
                   ": expected plumb_bob or rational_polynomial");
  }
  const bool finite =
      std::all_of(info.D.begin(), info.D.end(), [](double d) { return std::isfinite(d); });
  if (!finite || (!info.D.empty() && !is_distortion_count(info.D.size()))) {
    throw BadInput(who + "D: expected 4, 5 or 8 numbers, or none");
  }
  if (info.width == 0 || info.height == 0) {
    throw BadInput(who + "width, height: expected the size of the images");
  }
  const auto fault =
      camera_matrix_fault(K, static_cast<int>(info.width), static_cast<int>(info.height));
  if (fault) throw BadInput(who + "K: " + *fault);
  CameraModel camera;
  camera.name = name(side);
  camera.width = static_cast<int>(info.width), camera.height = static_cast<int>(info.height);
  camera.fx = K(0, 0), camera.cx = K(0, 2), camera.fy = K(1, 1), camera.cy = K(1, 2);
  std::copy(info.D.begin(), info.D.end(), camera.distortion.begin());
  camera.R = Eigen::Map<const RowMajor3>(info.R.data());
  camera.P = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(info.P.data());
  if (!is_rotation(camera.R)) {
    throw BadInput(who + "R: expected a rotation; the calibration is mirrored or broken");
  }
  if (!is_rectified(camera.P)) {
    throw BadInput(who + "P: expected a rectified camera [f, 0, cx, Tx, 0, f, cy, ...]");
  }
  return camera;
}

sensor_msgs::CameraInfo camera_info(const CameraModel& camera) {
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = sensor_msgs::distortion_models::RATIONAL_POLYNOMIAL;
  info.D.assign(camera.distortion.begin(), camera.distortion.end());
  info.K = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(info.R.data()) = camera.R;
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(info.P.data()) = camera.P;
  return info;
}

TimedImage timed_image(const sensor_msgs::ImageConstPtr& message) {
  if (message->encoding != sensor_msgs::image_encodings::MONO8 &&
      message->encoding != sensor_msgs::image_encodings::TYPE_8UC1) {
    throw BadInput("encoding " + message->encoding + ": expected mono8");
  }
  if (message->step < message->width ||
      message->data.size() < std::size_t{message->step} * message->height) {
    throw BadInput(std::to_string(message->data.size()) + " bytes: truncated");
  }
  if (message->header.stamp.isZero()) {
    throw BadInput("stamp 0: expected the time of the exposure");
  }
  TimedImage image;
  image.t = message->header.stamp.toSec();
  image.ns = static_cast<std::int64_t>(message->header.stamp.toNSec());
  image.image = {message->data.data(), static_cast<int>(message->width),
                 static_cast<int>(message->height), message->step};
  image.owner = std::shared_ptr<const void>(message.get(), [message](const void*) {});
  return image;
}

Pose pose(const geometry_msgs::Transform& transform) {
  const auto& q = transform.rotation;
  const auto& p = transform.translation;
  return {Quat(q.w, q.x, q.y, q.z).normalized().toRotationMatrix(), {p.x, p.y, p.z}};
}

geometry_msgs::TransformStamped transform(const Pose& X, const std_msgs::Header& header,
                                          const std::string& child_frame) {
  geometry_msgs::TransformStamped message;
  message.header = header;
  message.child_frame_id = child_frame;
  message.transform.translation = vector_message(X.p);
  message.transform.rotation = quaternion_message(canonical(Quat(X.R)));
  return message;
}

anthrob_msgs::SphericalJointStates spherical_joint_states(const StereoFrame& frame,
                                                          const TargetSet& set,
                                                          const std_msgs::Header& header) {
  anthrob_msgs::SphericalJointStates states;
  states.header.stamp = header.stamp;
  for (std::size_t j = 0; j < frame.joints.size(); ++j) {
    const JointEstimate& joint = frame.joints[j];
    if (!joint.valid || !joint.velocity_valid) continue;
    states.name.push_back(set.joints[j].name);
    states.orientation.push_back(quaternion_message(joint.q));
    states.angular_velocity.push_back(vector_message(joint.velocity));
  }
  return states;
}

geometry_msgs::PoseWithCovarianceStamped pose_message(const TargetPose& target,
                                                      const std_msgs::Header& header) {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header = header;
  message.pose.pose.position = point_message(target.X.p);
  message.pose.pose.orientation = quaternion_message(canonical(Quat(target.X.R)));
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(message.pose.covariance.data()) =
      target.covariance;
  return message;
}

sensor_msgs::Imu joint_message(const JointEstimate& joint, const std_msgs::Header& header) {
  using Rows = Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
  sensor_msgs::Imu message;
  message.header = header;
  message.orientation = quaternion_message(joint.q);
  Rows(message.orientation_covariance.data()) = joint.covariance;
  message.angular_velocity = vector_message(joint.velocity);
  Rows(message.angular_velocity_covariance.data()) = joint.velocity_covariance;
  message.linear_acceleration_covariance[0] = -1.0;  // the message's way to say: not measured
  return message;
}

visualization_msgs::MarkerArray marker_array(const StereoFrame& frame, const TargetSet& set,
                                             const std_msgs::Header& header) {
  visualization_msgs::Marker spheres;
  spheres.header = header;
  spheres.ns = "points";
  spheres.type = visualization_msgs::Marker::SPHERE_LIST;
  spheres.pose.orientation.w = 1.0;
  spheres.scale.x = spheres.scale.y = spheres.scale.z = std::max(0.005, set.marker_diameter);
  for (std::size_t i = 0; i < frame.points.size(); ++i) {
    std_msgs::ColorRGBA colour;
    colour.r = colour.g = colour.b = 0.4f, colour.a = 0.6f;
    for (std::size_t k = 0; k < frame.targets.size(); ++k) {
      const std::vector<int>& labels = frame.labels[k].point;
      if (!frame.targets[k].valid ||
          std::find(labels.begin(), labels.end(), static_cast<int>(i)) == labels.end()) {
        continue;
      }
      colour.r = k % 3 == 1 ? 1.0f : 0.1f, colour.g = k % 3 == 0 ? 0.9f : 0.5f;
      colour.b = k % 3 == 2 ? 1.0f : 0.1f, colour.a = 1.0f;
    }
    spheres.points.push_back(point_message(frame.points[i].p));
    spheres.colors.push_back(colour);
  }
  if (spheres.points.empty()) spheres.action = visualization_msgs::Marker::DELETE;
  visualization_msgs::MarkerArray array;
  array.markers.push_back(spheres);
  return array;
}

sensor_msgs::Image image_message(const ColourImage& image, const std_msgs::Header& header) {
  sensor_msgs::Image message;
  message.header = header;
  message.width = static_cast<std::uint32_t>(image.width);
  message.height = static_cast<std::uint32_t>(image.height);
  message.encoding = sensor_msgs::image_encodings::BGR8;
  message.step = 3 * message.width;
  message.data = image.pixels;
  return message;
}

}  // namespace mocap
}  // namespace anthrob
