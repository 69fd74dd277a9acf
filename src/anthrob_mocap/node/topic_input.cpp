#include "topic_input.h"

#include <ros/topic.h>

#include "anthrob_core/errors.h"
#include "conversions.h"

namespace anthrob {
namespace mocap {

std::optional<StereoRig> wait_for_rig(ros::NodeHandle nh) {
  sensor_msgs::CameraInfoConstPtr info[2];
  for (const Side side : {kLeft, kRight}) {
    const std::string topic = nh.resolveName(std::string(name(side)) + "/camera_info");
    while (ros::ok() && !info[side]) {
      info[side] = ros::topic::waitForMessage<sensor_msgs::CameraInfo>(topic, ros::Duration(5.0));
      if (!info[side]) ROS_WARN_STREAM("waiting for " << topic);
    }
  }
  if (!info[kLeft] || !info[kRight]) return std::nullopt;
  return StereoRig(camera_model(*info[kLeft], kLeft), camera_model(*info[kRight], kRight),
                   " camera_info");
}

TopicInput::TopicInput(ros::NodeHandle nh, double tolerance, Handler handler, Refuse refuse)
    : handler_(std::move(handler)),
      refuse_(std::move(refuse)),
      pairing_(tolerance),
      transport_(nh) {
  const image_transport::TransportHints hints("raw", ros::TransportHints().tcpNoDelay(), nh);
  for (const Side side : {kLeft, kRight}) {
    subscribers_[side] = transport_.subscribe(
        std::string(name(side)) + "/image_raw", 8,
        [this, side](const sensor_msgs::ImageConstPtr& message) { on_image(side, message); },
        ros::VoidPtr(), hints);
  }
}

void TopicInput::on_image(Side side, const sensor_msgs::ImageConstPtr& message) {
  TimedImage pair[2];
  try {
    if (pairing_.add(side, timed_image(message), pair)) handler_(pair);
  } catch (const BadInput& error) {
    refuse_(std::string(name(side)) + " image: " + error.what());
  }
}

}  // namespace mocap
}  // namespace anthrob
