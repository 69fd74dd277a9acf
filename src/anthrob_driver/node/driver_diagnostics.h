#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <string>

#include "anthrob_driver/robot_driver.h"

namespace anthrob {
namespace driver {

/// What diagnostics say of the driver and the bus.
/// @param robot name of the robot, "/anthrob"
diagnostic_msgs::DiagnosticStatus driver_status(const RobotDriver& driver, double now,
                                                const std::string& robot);
/// The same of one ECU.
diagnostic_msgs::DiagnosticStatus ecu_status(const RobotDriver& driver, std::size_t ecu, double now,
                                             const std::string& robot);

}  // namespace driver
}  // namespace anthrob
