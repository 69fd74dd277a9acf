#include "anthrob_calib/discovery/experiment.h"

#include <algorithm>

#include "anthrob_calib/discovery/axis_experiment.h"
#include "anthrob_calib/discovery/chain_experiment.h"

namespace anthrob {
namespace discovery {

std::shared_ptr<const Experiment> make_experiment(const RobotModel& model, const Dataset& recording,
                                                  const ExperimentOptions& options) {
  if (!model.muscles.empty()) {
    return std::make_shared<ChainExperiment>(model, recording, options);
  }
  const auto& joints = model.skeleton->joints;
  const bool driven = std::any_of(joints.begin(), joints.end(),
                                  [](const JointModel& joint) { return joint.driven; });
  if (!driven) {
    throw BadInput(model.file + ": expected muscles, or a joint with driven: true");
  }
  return std::make_shared<AxisExperiment>(model, recording, options);
}

}  // namespace discovery
}  // namespace anthrob
