#pragma once

#include <anthrob_msgs/MomentArms.h>
#include <anthrob_msgs/MusclePaths.h>
#include <anthrob_msgs/MuscleStates.h>
#include <anthrob_msgs/SetState.h>
#include <anthrob_msgs/SphericalJointStates.h>
#include <anthrob_msgs/TendonPaths.h>
#include <anthrob_msgs/TouchStates.h>
#include <diagnostic_msgs/DiagnosticStatus.h>
#include <geometry_msgs/TransformStamped.h>
#include <sensor_msgs/JointState.h>
#include <visualization_msgs/MarkerArray.h>

#include <vector>

#include "anthrob_ecu/supervisor.h"
#include "anthrob_sim/placement.h"
#include "anthrob_sim/simulation.h"

namespace anthrob {

/// What the supervisor must know of the robot's muscles.
std::vector<ecu::MuscleChannel> muscle_channels(const RobotModel& model);

/// @throws BadInput if names and values differ in number, or the robot cannot get there
void read_state(const anthrob_msgs::SetState::Request& request, Placement& placement);

anthrob_msgs::MuscleStates muscle_states(const Simulation& sim, const ecu::Supervisor& supervisor,
                                         const ros::Time& stamp);
sensor_msgs::JointState joint_states(const Simulation& sim, const ros::Time& stamp);
anthrob_msgs::SphericalJointStates spherical_joint_states(const Simulation& sim,
                                                          const ros::Time& stamp);
anthrob_msgs::TouchStates touch_states(const Simulation& sim, const ros::Time& stamp);

/// State of every ECU.
/// @param ns begins their names
std::vector<diagnostic_msgs::DiagnosticStatus> ecu_statuses(const ecu::Supervisor& supervisor,
                                                            const std::string& ns);

/// Ball joints, parent link to child link; the rest of the tree is robot_state_publisher's.
std::vector<geometry_msgs::TransformStamped> ball_joint_transforms(const Simulation& sim,
                                                                   const ros::Time& stamp);

/// What the muscles' paths are: contacts, tensions on both sides.
anthrob_msgs::MusclePaths solved_paths(const Simulation& sim, const ros::Time& stamp);
/// Of all muscles over all axes.
anthrob_msgs::MomentArms moment_arms(const Simulation& sim, const ros::Time& stamp);
/// Forces in the springs of all muscles [N].
std::vector<double> spring_tensions(const Simulation& sim);
/// Muscles along their solved paths, blue to red by force.
/// @param forces of all muscles [N]; grey where it is NaN
visualization_msgs::MarkerArray muscle_markers(const Simulation& sim,
                                               const std::vector<double>& forces,
                                               const ros::Time& stamp);
/// The same paths, each point in the frame of the link that carries it: its body's link, which is
/// a frame of tf.
/// @param forces of all muscles [N]; NaN: not measured
/// @param slack_force up to which a tendon counts as slack [N]
anthrob_msgs::TendonPaths tendon_paths(const Simulation& sim, const std::vector<double>& forces,
                                       double slack_force, const ros::Time& stamp);
/// Wrapping surfaces, fixed to their links.
visualization_msgs::MarkerArray surface_markers(const RobotModel& model);

}  // namespace anthrob
