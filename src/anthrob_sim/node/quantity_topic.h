#pragma once

#include <anthrob_msgs/ChooseQuantities.h>
#include <ros/ros.h>

#include <string>
#include <vector>

#include "anthrob_sim/simulation.h"
#include "report/quantities.h"

namespace anthrob {

/// The topic sim/quantities, and the service that chooses what is on it.
class QuantityTopic {
 public:
  /// @param sim must outlive it   @param paths that are on it from the start
  /// @throws BadInput naming a path that is not known
  QuantityTopic(ros::NodeHandle& nh, Simulation& sim, const std::vector<std::string>& paths);

  /// With the state of the same time.
  void publish(const ros::Time& stamp) const;

 private:
  void choose(const std::vector<std::string>& paths);
  bool on_choose(anthrob_msgs::ChooseQuantities::Request& request,
                 anthrob_msgs::ChooseQuantities::Response& response);

  Simulation& sim_;
  std::vector<Quantity> all_, chosen_;
  ros::Publisher publisher_;
  ros::ServiceServer service_;
};

}  // namespace anthrob
