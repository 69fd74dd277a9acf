#pragma once

#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/model/robot_model.h"
#include "measurement/description.h"

namespace anthrob {
namespace discovery {

/// What meta.yaml says of how a recording was taken: an entry of `measurement`, with the keys and
/// words of report.json.
struct Statement {
  std::string channel_kind;   ///< "force"
  std::string place = "all";  ///< or a muscle, a joint, a table of joints
  std::string what;           ///< delay | tick_phase | filter | sign | unit | clock | hold
  double value = 0.0;         ///< [unit]
  std::string unit;
};

/// @throws BadInput naming recording, key, value and what was expected
std::vector<Statement> statements_of(const RobotModel& robot, const Dataset& recording);

/// Undoes what all recordings say of themselves, and reports it. What is only held is found anyway.
void correct_as_stated(const RobotModel& robot, Description& description);

/// Remarks where what was found in the recordings is not what they say.
void tell_contradictions(Description& description);

}  // namespace discovery
}  // namespace anthrob
