#pragma once

#include <ros/ros.h>

#include <optional>
#include <string>

namespace anthrob {

/// @param topic as the master knows it, from the root
/// @return name of another living node that publishes it; none if there is no such node. One that
///   crashed does not count, although the master still lists it; one that hangs does count.
std::optional<std::string> living_publisher(const std::string& topic);

/// Makes sure that only one back end (simulator or driver) serves a robot. To be called before the
/// back end advertises or sends anything else: a service of the same name would replace that of the
/// running back end.
/// @return the publisher of `muscle_states`, to be kept while the back end runs. It is advertised
///   before the check, so that two back ends that start together both notice
/// @throws BadInput naming the node that publishes it already. The refused launch file may have set
///   `/use_sim_time`; it is first set back to what the running nodes need
ros::Publisher claim_robot(ros::NodeHandle& nh);

/// To be called by a node that has just advertised `/clock`: with two clocks on one master,
/// nobody's time goes forwards.
/// @throws BadInput naming another living node that publishes it
void refuse_other_clocks();

/// A launch file starts a simulator and a node that commands it. If a driver serves the robot, the
/// simulator is refused, and that node must not command the driver instead. To be called before the
/// node commands or enables anything.
/// @param own name of the only back end that it may command, in its namespace; empty: any
/// @throws BadInput naming another one that serves the robot, as claim_robot does
void refuse_other_back_ends(ros::NodeHandle& nh, const std::string& own);

/// If a launch file is started twice, two nodes have the same name, and ROS ends the first one when
/// the second one registers, even while the robot moves. To be called between ros::init and the
/// first NodeHandle, which registers.
/// @return whether a living node has this node's name; if so, it is logged
bool name_is_taken();

/// Sets `/use_sim_time`, which the launch file of a refused back end may have set, back to what the
/// running nodes need: true where a living node publishes the clock.
/// @param ending a node whose clock does not count, because it ends with the refused one
void restore_time(const std::string& ending = "");

}  // namespace anthrob
