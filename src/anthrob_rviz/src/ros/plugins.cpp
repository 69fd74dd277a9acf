// What RViz makes by name. Panels without arguments are connected over ROS.
#include <memory>
#include <pluginlib/class_list_macros.hpp>

#include "panel/gains_panel.h"
#include "panel/muscles_panel.h"
#include "panel/play_panel.h"
#include "panel/record_panel.h"
#include "panel/robot_panel.h"
#include "panel/scope_panel.h"
#include "panel/twin_panel.h"
#include "ros/ros_connection.h"
#include "ros/scope/scope_over_ros.h"
#include "ros/tendons_display.h"

namespace anthrob {

RobotPanel::RobotPanel()
    : RobotPanel(std::make_unique<RosConnection>(RosConnection::Role::kWatcher), default_robot()) {}

MusclesPanel::MusclesPanel()
    : MusclesPanel(std::make_unique<RosConnection>(RosConnection::Role::kCommander),
                   default_robot()) {}

GainsPanel::GainsPanel()
    : GainsPanel(std::make_unique<RosConnection>(RosConnection::Role::kWatcher), default_robot()) {}

RecordPanel::RecordPanel()
    : RecordPanel(std::make_unique<RosConnection>(RosConnection::Role::kWatcher), default_robot()) {
}

PlayPanel::PlayPanel()
    : PlayPanel(std::make_unique<RosConnection>(RosConnection::Role::kWatcher), default_robot()) {}

TwinPanel::TwinPanel()
    : TwinPanel(std::make_unique<RosConnection>(RosConnection::Role::kWatcher), default_robot()) {}

ScopePanel::ScopePanel() : ScopePanel(scope_over_ros()) {}

}  // namespace anthrob

PLUGINLIB_EXPORT_CLASS(anthrob::RobotPanel, rviz::Panel)
PLUGINLIB_EXPORT_CLASS(anthrob::MusclesPanel, rviz::Panel)
PLUGINLIB_EXPORT_CLASS(anthrob::GainsPanel, rviz::Panel)
PLUGINLIB_EXPORT_CLASS(anthrob::RecordPanel, rviz::Panel)
PLUGINLIB_EXPORT_CLASS(anthrob::PlayPanel, rviz::Panel)
PLUGINLIB_EXPORT_CLASS(anthrob::ScopePanel, rviz::Panel)
PLUGINLIB_EXPORT_CLASS(anthrob::TwinPanel, rviz::Panel)
PLUGINLIB_EXPORT_CLASS(anthrob::TendonsDisplay, rviz::Display)
