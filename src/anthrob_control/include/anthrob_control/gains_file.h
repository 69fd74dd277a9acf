#pragma once

#include <map>
#include <string>

#include "anthrob_sim/model/robot_model.h"

namespace anthrob {

/// Gains by their names, position_proportional and the like, of muscles by theirs.
using HeldGains = std::map<std::string, std::map<std::string, double>>;

/// A model file with the gains that a robot holds: what extends the model, and `gains:` of the
/// muscles that hold others than the model's. Units hold float 32: a gain that only differs from
/// the model's by that does not differ.
/// @param extends the model's file as it is seen from the new one
/// @return empty if no gain differs
/// @throws BadInput for muscles that the model has not, or that have no controller
std::string gains_file(const RobotModel& model, const HeldGains& held, const std::string& extends);

}  // namespace anthrob
