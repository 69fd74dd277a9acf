#include "measurement/replays.h"

#include "anthrob_core/errors.h"
#include "experiment/chain_experiment.h"

namespace anthrob {
namespace discovery {

std::vector<std::optional<Dataset>> replays(const Evaluator& evaluator,
                                            const std::vector<Dataset*>& recordings,
                                            std::optional<ReplayMode> feed) {
  std::vector<std::optional<Dataset>> all(recordings.size());
  if (evaluator.model()->muscles.empty()) return all;
  evaluator.side_by_side(recordings.size(), [&](std::size_t r) {
    const Dataset& recording = *recordings[r];
    const auto robot = evaluator.build({}, recording.meta.model);
    std::string failure;
    try {
      Dataset simulated =
          replay(robot, recording, feed.value_or(mode_of(*robot, recording)), {}, &failure);
      if (failure.empty()) all[r] = std::move(simulated);
    } catch (const BadInput&) {  // what is wrong with it is told where it is used
    }
  });
  return all;
}

}  // namespace discovery
}  // namespace anthrob
