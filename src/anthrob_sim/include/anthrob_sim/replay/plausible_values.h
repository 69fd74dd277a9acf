#pragma once

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/model/robot_model.h"

namespace anthrob {

/// Refuses numbers that nobody can have measured: positions far beyond a joint's stops (in degrees
/// or millimetres), tendons that push (a force sensor with the other sign).
/// @throws BadInput with file, row and column
void refuse_implausible_values(const RobotModel& robot, const Dataset& recording);

/// Refuses what is not finite, or beyond 1e9 in whatever unit. @throws BadInput as above
void refuse_no_numbers(const Dataset& recording);

/// @throws BadInput "FOLDER/TABLE.csv: row N: complaint", counted from 1
/// @param row counted from 0
[[noreturn]] void refuse_row(const Dataset& recording, const Table& table, std::size_t row,
                             const std::string& complaint);

}  // namespace anthrob
