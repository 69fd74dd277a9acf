#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "anthrob_sim/model/robot_model.h"
#include "conclusion/answer.h"

namespace anthrob {
namespace discovery {

/// Protocols and postures for the recorder that tell effects from their first rivals. @return texts
/// by file name
std::map<std::string, std::string> separating_files(const Answer& answer, const RobotModel& model);

/// "separating_1.yaml", of the first effect. @param number of the effect, from 1
std::string separating_file(std::size_t number);

}  // namespace discovery
}  // namespace anthrob
