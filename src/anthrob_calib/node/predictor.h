#pragma once

#include <anthrob_msgs/Predict.h>
#include <ros/ros.h>

#include "twin/twins.h"

namespace anthrob {

/// The service `predict`: runs a copy of the model ahead of the robot.
class Predictor {
 public:
  /// @param twins must outlive it   @param nh of the robot's namespace
  Predictor(const twin::Twins& twins, ros::NodeHandle nh);

 private:
  bool serve(const anthrob_msgs::Predict::Request& request,
             anthrob_msgs::Predict::Response& response) const;

  const twin::Twins& twins_;
  ros::ServiceServer server_;
};

}  // namespace anthrob
