#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "anthrob_ros/parameters.h"
#include "anthrob_ros/run_node.h"
#include "conversions.h"
#include "joint/joint_estimator.h"
#include "virtual_rig.h"

namespace anthrob {
namespace mocap {

namespace {

constexpr double kLargestLag = 0.5;  // [s] behind tf; then pictures are skipped
constexpr double kPatience = 5.0;    // [s] of wall time until it is said what tf lacks

}  // namespace

VirtualRig::VirtualRig(ros::NodeHandle nh, const StereoRig& rig, const TargetSet& set,
                       const Setup& setup)
    : rig_(rig),
      set_(set),
      setup_(setup),
      renderer_(rig, setup.render),
      listener_(buffer_, nh, true, ros::TransportHints().tcpNoDelay()),
      gaps_({JointEstimator::kLongestGap, tf2::BufferCore::DEFAULT_CACHE_TIME}),
      stamps_(nh.subscribe("/tf", 1000, &VirtualRig::keep_stamps, this)),
      transport_(nh) {
  for (const Side side : {kLeft, kRight}) {
    publishers_[side] = transport_.advertiseCamera(std::string(name(side)) + "/image_raw", 8);
  }
}

/// How far tf reaches for all links; zero if it does not know them yet.
ros::Time VirtualRig::latest() {
  ros::Time common(ros::TIME_MAX);
  for (const Setup::Mount& mount : setup_.mounts) {
    try {
      const ros::Time t =
          buffer_.lookupTransform(setup_.camera_parent, mount.link, ros::Time(0)).header.stamp;
      // Static transforms have stamp zero: they reach anywhere.
      if (!t.isZero()) common = std::min(common, t);
    } catch (const tf2::TransformException& error) {
      missing_ = error.what();
      return ros::Time();
    }
  }
  return common == ros::Time(ros::TIME_MAX) ? ros::Time::now() : common;
}

void VirtualRig::keep_stamps(const tf2_msgs::TFMessage& message) {
  for (const auto& transform : message.transforms) {
    gaps_.add(transform.child_frame_id, transform.header.stamp.toSec());
  }
}

void VirtualRig::run() {
  const ros::Duration half_exposure(0.5 * setup_.exposure);
  ros::Time next;
  while (ros::ok()) {
    const ros::Time reach = latest();
    ros::spinOnce();  // the stamps up to there
    const bool jumped =
        next > reach + ros::Duration(1.0) || reach > next + ros::Duration(kLargestLag);
    if (!reach.isZero() && (next.isZero() || jumped)) {
      // On the grid of whole periods, so that a rerun sees the same instants.
      next.fromSec(std::ceil(reach.toSec() * setup_.rate) / setup_.rate);
    }
    if (!reach.isZero()) last_reach_ = ros::WallTime::now();
    if ((ros::WallTime::now() - last_reach_).toSec() > kPatience) {
      ROS_WARN_STREAM("no pictures: " << missing_);
      last_reach_ = ros::WallTime::now();
    }
    if (reach.isZero() || next.isZero() || next + half_exposure > reach) {
      ros::WallDuration(0.001).sleep();
      continue;
    }
    expose(next);
    next.fromSec((std::round(next.toSec() * setup_.rate) + 1.0) / setup_.rate);
  }
}

void VirtualRig::expose(const ros::Time& stamp) {
  std::vector<Scene> instants(static_cast<std::size_t>(setup_.instants));
  for (int i = 0; i < setup_.instants; ++i) {
    const double offset = setup_.exposure * ((i + 0.5) / setup_.instants - 0.5);
    if (!scene_at(stamp + ros::Duration(offset), instants[static_cast<std::size_t>(i)])) return;
  }
  publish(stamp, instants);
}

/// The frame between the cameras and a link that has a gap in tf at a time; none if none has.
std::optional<std::string> VirtualRig::frame_with_gap(const std::string& link,
                                                      const ros::Time& time) const {
  std::vector<std::string> chain;
  buffer_._chainAsVector(setup_.camera_parent, time, link, time, link, chain);
  const auto at = std::find_if(chain.begin(), chain.end(), [&](const std::string& frame) {
    return gaps_.hold(frame, time.toSec());
  });
  if (at == chain.end()) return std::nullopt;
  return *at;
}

bool VirtualRig::scene_at(const ros::Time& time, Scene& scene) const {
  const Pose X_CP = setup_.X_PC.inverse();
  try {
    for (std::size_t k = 0; k < set_.targets.size(); ++k) {
      const Setup::Mount& mount = setup_.mounts[k];
      if (const auto frame = frame_with_gap(mount.link, time)) {
        ROS_WARN_STREAM_THROTTLE(1.0, "no image rendered: tf of "
                                          << *frame << " has a gap of more "
                                          << "than " << JointEstimator::kLongestGap << " s");
        return false;
      }
      const Pose X_PL =
          pose(buffer_.lookupTransform(setup_.camera_parent, mount.link, time).transform);
      const Pose X_CT = X_CP * X_PL * mount.X_LT;
      for (const Vec3& marker : set_.targets[k].markers) {
        scene.spheres.push_back({X_CT * marker, 0.5 * set_.marker_diameter, setup_.brightness});
      }
    }
  } catch (const tf2::TransformException& error) {
    ROS_WARN_STREAM_THROTTLE(1.0, "no image rendered: " << error.what());
    return false;
  }
  scene.spheres.insert(scene.spheres.end(), setup_.distractors.begin(), setup_.distractors.end());
  return true;
}

void VirtualRig::publish(const ros::Time& stamp, const std::vector<Scene>& instants) {
  for (const Side side : {kLeft, kRight}) {
    renderer_.render(side, instants, frame_, image_);
    const auto message = boost::make_shared<sensor_msgs::Image>();
    message->header.stamp = stamp;
    message->header.frame_id = std::string("mocap_") + name(side);
    message->width = static_cast<std::uint32_t>(image_.width);
    message->height = static_cast<std::uint32_t>(image_.height);
    message->encoding = sensor_msgs::image_encodings::MONO8;
    message->step = message->width;
    message->data = image_.pixels;
    const auto info = boost::make_shared<sensor_msgs::CameraInfo>(camera_info(rig_.camera(side)));
    info->header = message->header;
    publishers_[side].publish(message, info);
  }
  ++frame_;
}

}  // namespace mocap
}  // namespace anthrob

int main(int argc, char** argv) {
  namespace mocap = anthrob::mocap;
  anthrob::NodeInfo info;
  info.name = "virtual_rig";
  info.purpose =
      "Renders the images of two virtual cameras that see the markers of a simulated robot.";
  info.parameters = {
      {"calibration", "folder with left.yaml and right.yaml (required)"},
      {"targets", "path of targets.yaml (required)"},
      {"rig", "path of rig.yaml (required)"},
  };
  return anthrob::run_node(argc, argv, info, [](ros::NodeHandle& nh, ros::NodeHandle& settings) {
    const auto rig = mocap::StereoRig::load(
        anthrob::required(settings, "calibration", "a folder with left.yaml and right.yaml"));
    // Ambiguous targets can be drawn; only the tracker must refuse them.
    const auto set =
        mocap::TargetSet::load(anthrob::required(settings, "targets", "the path of targets.yaml"),
                               mocap::TargetSet::kUnchecked);
    const auto setup =
        mocap::Setup::load(anthrob::required(settings, "rig", "the path of rig.yaml"), set);
    mocap::VirtualRig(ros::NodeHandle(nh, "mocap"), rig, set, setup).run();
    return 0;
  });
}
