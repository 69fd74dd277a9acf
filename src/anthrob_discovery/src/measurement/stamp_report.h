#pragma once

#include <string>
#include <vector>

#include "measurement/controller_algebra.h"
#include "measurement/description.h"

namespace anthrob {
namespace discovery {

/// "position and force"
std::string kind_word(LateStamp what);
/// Moves these quantities of all muscles, wherever they are recorded.
void move_earlier(const RobotModel& robot, const std::vector<std::string>& quantities, double late,
                  Dataset& recording);
/// Voltages that are logged after the tick. @param sigma [s]
void report_tick_phase(double tick, double sigma, Description& description);
void report_shift(const StampShift& shift, Description& description);

}  // namespace discovery
}  // namespace anthrob
