#pragma once

#include <anthrob_msgs/MuscleStates.h>
#include <anthrob_msgs/SphericalJointStates.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <tf2_ros/transform_broadcaster.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_ros/clock_wait.h"
#include "anthrob_sim/simulation.h"
#include "surface_display.h"

namespace anthrob {

/// Draws a robot's tendons where its measured joints put them, in the colours of the measured
/// forces, and tells their lengths and contacts: what the simulator shows of itself. Commands
/// nothing.
class TendonDisplay {
 public:
  /// @param joint_tf whether to publish the measured ball joints in tf, too; where nobody else does
  TendonDisplay(std::shared_ptr<const RobotModel> model, ros::NodeHandle nh, bool joint_tf);

 private:
  void see_muscles(const anthrob_msgs::MuscleStates& message);
  void see_joints(const sensor_msgs::JointState& message);
  void see_ball_joints(const anthrob_msgs::SphericalJointStates& message);
  /// Takes a joint's position, if it is one: numbers that are finite, and of a ball joint a
  /// rotation.
  void see_joint(const std::string& name, const std::vector<double>& position,
                 const ros::Time& stamp);
  void draw();
  void tell(const ros::Time& stamp);
  /// The first joint that was not measured lately; none if all were.
  std::optional<std::string> missing(const ros::Time& now) const;

  Simulation sim_;
  std::vector<double> q_;       ///< of all joints, as Simulation::place takes them
  std::vector<double> forces_;  ///< of all muscles [N]; NaN: not measured
  ros::Time forces_stamp_;
  std::vector<ros::Time> stamps_;  ///< of all joints
  SurfaceDisplay surfaces_;
  ros::Publisher paths_, tendon_paths_, solved_paths_, moment_arms_;
  std::optional<tf2_ros::TransformBroadcaster> transforms_;  ///< of ball joints
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer timer_;
  ros::Time whole_;  ///< when all joints were last measured; at first, when drawing began
  ClockWait clock_wait_;
};

}  // namespace anthrob
