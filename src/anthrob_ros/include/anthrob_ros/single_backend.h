#pragma once

#include <ros/ros.h>

#include <string>

namespace anthrob {

/// @param topic as the master knows it, from the root
/// @return name of another living node that publishes it; empty if there is none. A node that
///   crashed does not count, although the master still lists it; one that hangs does count.
std::string living_publisher(const std::string& topic);

/// Makes sure that only one back end (simulator or driver) serves a robot. To be called before the
/// back end advertises or sends anything else: a service of the same name would replace that of the
/// running back end.
/// @return the publisher of `muscle_states`, to be kept while the back end runs. It is advertised
///   before the check, so that two back ends that start together both notice
/// @throws BadInput naming the node that publishes it already. The refused launch file may have set
///   `/use_sim_time`; it is first set back to what the running nodes need
ros::Publisher claim_robot(ros::NodeHandle& nh);

/// If a launch file is started twice, two nodes have the same name, and ROS ends the first one when
/// the second one registers, even while the robot moves. To be called between ros::init and the
/// first NodeHandle, which registers.
/// For back ends only, because it sets `/use_sim_time` back as claim_robot does.
/// @return whether a living node has this node's name; if so, it is logged
bool name_is_taken();

}  // namespace anthrob
