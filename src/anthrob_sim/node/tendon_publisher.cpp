#include "tendon_publisher.h"

#include "anthrob_sim/conversions.h"

namespace anthrob {

TendonPublisher::TendonPublisher(ros::NodeHandle& nh, const Simulation& sim, double rate,
                                 std::function<bool()> sound)
    : sim_(sim),
      sound_(std::move(sound)),
      publisher_(nh.advertise<anthrob_msgs::TendonPaths>("tendon_paths", 2)),
      timer_(nh.createWallTimer(ros::WallDuration(1.0 / rate),
                                [this](const ros::WallTimerEvent&) { publish(); })) {}

void TendonPublisher::publish() {
  if (publisher_.getNumSubscribers() == 0 || !sound_()) return;
  const ros::Time stamp(sim_.time());
  publisher_.publish(tendon_paths(sim_, spring_tensions(sim_), 0.0, stamp));
}

}  // namespace anthrob
