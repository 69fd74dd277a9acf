#include <pluginlib/class_list_macros.hpp>

#include "panel/robot_panel.h"

PLUGINLIB_EXPORT_CLASS(anthrob::RobotPanel, rviz::Panel)
