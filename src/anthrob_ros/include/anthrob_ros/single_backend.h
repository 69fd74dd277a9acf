#pragma once

#include <ros/ros.h>

#include <string>

namespace anthrob {

/// @param topic as the master knows it, from the root
/// @return name of another living node that publishes it; empty if there is none. A node that died
///   without saying so does not count; one that is held up does.
std::string living_publisher(const std::string& topic);

/// Simulator and driver must not both speak for one robot. To be called before anything else is
/// advertised or sent: a service of the same name would take the place of the other one's.
/// @return the claim, `muscle_states`, to be held while the back end runs; it is advertised before
///   the look round, so that of two that start together both notice
/// @throws BadInput naming who publishes it already; `/use_sim_time`, which the refused launch file
///   may have set, is then what the clock of those who run asks for
ros::Publisher claim_robot(ros::NodeHandle& nh);

/// A launch file that is started twice gives two nodes one name, and ROS ends the first when the
/// second one registers, in motion or not. To be called between ros::init and the first NodeHandle,
/// which registers.
/// Of back ends only, for `/use_sim_time` is put right as by claim_robot.
/// @return whether a living node has this node's name; the log says so then
bool name_is_taken();

}  // namespace anthrob
