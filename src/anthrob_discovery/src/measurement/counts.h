#pragma once

#include "anthrob_sim/model/robot_model.h"
#include "measurement/description.h"

namespace anthrob {
namespace discovery {

/// Tells which sensors count by other steps than the model's do. Nothing is to be corrected: floors
/// have what steps leave.
void report_counts(const RobotModel& robot, Description& description);

}  // namespace discovery
}  // namespace anthrob
