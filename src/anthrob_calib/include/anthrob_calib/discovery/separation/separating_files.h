#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "anthrob_calib/discovery/discovery.h"
#include "anthrob_sim/model/robot_model.h"

namespace anthrob {
namespace discovery {

/// Protocols and postures for the recorder that tell effects from their first rivals. @return texts
/// by file name
std::map<std::string, std::string> separating_files(const Answer& answer, const RobotModel& model);

/// Removes protocols of an earlier answer from the folder.
/// @param files files of this answer by name, which stay
void remove_other_protocols(const std::string& folder,
                            const std::map<std::string, std::string>& files);

/// "separating_1.yaml", of the first effect. @param number of the effect, from 1
std::string separating_file(std::size_t number);

}  // namespace discovery
}  // namespace anthrob
