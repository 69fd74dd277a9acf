#pragma once

#include <ros/ros.h>

#include <functional>

#include "anthrob_sim/simulation.h"

namespace anthrob {

/// The topic tendon_paths of a simulation: at a rate of wall time, so that who starts to draw while
/// it is paused sees it too, and only while somebody subscribes.
class TendonPublisher {
 public:
  /// @param sim must outlive it
  /// @param rate [Hz]
  /// @param sound whether the simulation's numbers are a state
  TendonPublisher(ros::NodeHandle& nh, const Simulation& sim, double rate,
                  std::function<bool()> sound);

 private:
  void publish();

  const Simulation& sim_;
  std::function<bool()> sound_;
  ros::Publisher publisher_;
  ros::WallTimer timer_;
};

}  // namespace anthrob
