#pragma once

#include <anthrob_msgs/Snapshot.h>
#include <ros/ros.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "anthrob_sim/simulation.h"

namespace anthrob {

/// The services sim/save and sim/restore. Simulated time goes on after a snapshot was restored;
/// everything else is as it was when it was saved.
class Snapshots {
 public:
  static constexpr std::size_t kMost = 100;

  /// @param sim must outlive it
  /// @param failed why the simulation stands still, if it does: what broke down is not saved
  /// @param restore brings the node to a snapshot
  Snapshots(ros::NodeHandle& nh, const Simulation& sim, std::function<std::string()> failed,
            std::function<void(const Snapshot& snapshot)> restore);

 private:
  using Named = std::pair<std::string, Snapshot>;

  bool on_save(anthrob_msgs::Snapshot::Request& request,
               anthrob_msgs::Snapshot::Response& response);
  bool on_restore(anthrob_msgs::Snapshot::Request& request,
                  anthrob_msgs::Snapshot::Response& response);
  std::vector<std::string> names() const;
  std::vector<Named>::iterator find(const std::string& name);

  const Simulation& sim_;
  std::function<std::string()> failed_;
  std::function<void(const Snapshot&)> restore_;
  std::vector<Named> saved_;  ///< in the order of their first use
  std::vector<ros::ServiceServer> services_;
};

}  // namespace anthrob
