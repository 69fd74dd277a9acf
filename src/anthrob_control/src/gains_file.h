#pragma once

#include <map>
#include <string>

#include "anthrob_sim/model/robot_model.h"

namespace anthrob {

/// Muscle name -> gain name (such as position_proportional) -> value.
using HeldGains = std::map<std::string, std::map<std::string, double>>;

/// Text of a model file with the gains that a robot holds: it extends the model, and has `gains:`
/// for the muscles whose gains differ from the model's, if any do. Units hold float 32, so gains
/// that are equal as float 32 do not count as different.
/// @param extends path of the model's file, relative to the new file
/// @throws BadInput for muscles that the model lacks, or that have no controller
std::string gains_file(const RobotModel& model, const HeldGains& held, const std::string& extends);

}  // namespace anthrob
