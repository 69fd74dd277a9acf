#include <pluginlib/class_list_macros.hpp>

#include "panel/muscles_panel.h"
#include "panel/robot_panel.h"

PLUGINLIB_EXPORT_CLASS(anthrob::RobotPanel, rviz::Panel)
PLUGINLIB_EXPORT_CLASS(anthrob::MusclesPanel, rviz::Panel)
