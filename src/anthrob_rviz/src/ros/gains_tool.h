#pragma once

#include <string>

#include "timed_calls.h"

namespace anthrob {

/// Saves the gains that a robot holds, by the tool anthrob_gains: a model file that extends the
/// model of the robot's back end.
/// @param robot its namespace from the root   @param file the new model file
TimedCalls::Call call_of_gains_tool(const std::string& robot, const std::string& file);

}  // namespace anthrob
