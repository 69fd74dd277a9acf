#include "anthrob_sim/model/recorded_model.h"

#include "anthrob_core/errors.h"
#include "anthrob_recording/table.h"

namespace anthrob {

std::shared_ptr<const RobotModel> build_recorded(const RobotDescription& robot,
                                                 const Dataset& recording, LoadOptions options) {
  const auto& known = recording.meta.model;
  if (known.empty()) return robot.build(options);
  const std::string where = recording.folder + ": meta.yaml: model";
  ConfigNode file = robot.config().clone();
  for (const auto& [path, value] : known) {
    try {
      file.set_number(path, value);
    } catch (const BadInput&) {
      throw BadInput(where + "." + path + ": " + exact_text(value) +
                     ": expected the key path of a number in " + file.file());
    }
  }
  robot.build(options);  // what is wrong without them is not their fault
  for (const auto& [path, value] : known) options.overrides[path] = value;
  try {
    return robot.build(options);
  } catch (const BadInput& error) {
    throw BadInput(where + ": " + error.what());
  }
}

}  // namespace anthrob
