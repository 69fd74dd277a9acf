#include "experiment/experiment.h"

#include <algorithm>

#include "experiment/axis_experiment.h"
#include "experiment/chain_experiment.h"
#include "experiment/pose_experiment.h"
#include "experiment/poses.h"

namespace anthrob {
namespace discovery {

std::shared_ptr<const Experiment> make_experiment(const RobotModel& model, const Dataset& recording,
                                                  const ExperimentOptions& options,
                                                  const ReplayScope& scope) {
  if (!model.muscles.empty()) {
    return std::make_shared<ChainExperiment>(model, recording, options, scope);
  }
  const auto& joints = model.skeleton->joints;
  const bool driven = std::any_of(joints.begin(), joints.end(),
                                  [](const JointModel& joint) { return joint.driven; });
  if (!driven) {
    throw BadInput(model.file +
                   ": nothing to compare: expected muscles, or a joint with `driven: true`");
  }
  if (holds_poses(model, recording)) {
    return std::make_shared<PoseExperiment>(model, recording, options.poses);
  }
  return std::make_shared<AxisExperiment>(model, recording, options.axis, scope);
}

double total_duration(const Experiments& experiments) {
  double sum = 0.0;
  for (const auto& experiment : experiments) sum += experiment->duration();
  return sum;
}

const Channel* find_channel(const Experiment& experiment, const Channel& channel) {
  for (const Channel& own : experiment.channels()) {
    if (own.name() == channel.name() && own.component == channel.component) return &own;
  }
  return nullptr;
}

std::vector<Channel> channels_of(const Experiments& experiments) {
  std::vector<Channel> channels;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    for (const Channel& channel : experiments[e]->channels()) {
      const bool known = std::any_of(
          experiments.begin(), experiments.begin() + static_cast<std::ptrdiff_t>(e),
          [&](const auto& earlier) { return find_channel(*earlier, channel) != nullptr; });
      if (!known) channels.push_back(channel);
    }
  }
  return channels;
}

}  // namespace discovery
}  // namespace anthrob
