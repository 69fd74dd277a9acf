#pragma once

#include <image_transport/image_transport.h>
#include <image_transport/subscriber.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "camera/stereo_rig.h"
#include "source/pairing.h"

namespace anthrob {
namespace mocap {

/// The rig of left/camera_info and right/camera_info; waits for them.
/// @return nothing if the node was stopped before they came
/// @throws BadInput if they are no calibrated pair
std::optional<StereoRig> wait_for_rig(ros::NodeHandle nh);

/// Pairs of left/image_raw and right/image_raw.
class TopicInput {
 public:
  using Handler = std::function<void(const TimedImage pair[2])>;
  using Refuse = std::function<void(const std::string& why)>;

  /// @param tolerance [s] between stamps of a pair; 0 for cameras that are triggered together
  TopicInput(ros::NodeHandle nh, double tolerance, Handler handler, Refuse refuse);

  /// What became of the images since the last call.
  Pairing::Counts take_counts() { return pairing_.take_counts(); }
  double tolerance() const { return pairing_.tolerance(); }  ///< [s] as Pairing's
  double period() const { return pairing_.period(); }        ///< [s] as Pairing's

 private:
  void on_image(Side side, const sensor_msgs::ImageConstPtr& message);

  Handler handler_;
  Refuse refuse_;
  Pairing pairing_;
  image_transport::ImageTransport transport_;
  image_transport::Subscriber subscribers_[2];
};

}  // namespace mocap
}  // namespace anthrob
