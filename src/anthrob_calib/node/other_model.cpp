#include "other_model.h"

#include <vector>

#include "anthrob_core/errors.h"
#include "anthrob_core/robots.h"
#include "anthrob_core/text.h"

namespace anthrob {

namespace {

/// What measurements are named by.
std::vector<std::string> names_in(const RobotModel& model) {
  std::vector<std::string> names;
  for (const MuscleModel& muscle : model.muscles) names.push_back(muscle.name);
  for (const JointModel& joint : model.skeleton->joints) names.push_back(joint.name);
  return names;
}

}  // namespace

std::shared_ptr<const RobotModel> other_model(const std::string& file, const RobotModel& present) {
  auto model = load_robot_model(find_model_file(file));
  if (names_in(*model) != names_in(present)) {
    throw BadInput(model->file + ": a model of another robot: expected the muscles and joints of " +
                   present.file + ": " + joined(names_in(present)));
  }
  return model;
}

}  // namespace anthrob
