#include "experiment/excerpt.h"

#include <algorithm>

namespace anthrob {
namespace discovery {

Excerpt excerpt(const RobotModel& model, const std::vector<Dataset>& recordings,
                const Experiments& whole, double seconds, const ExperimentOptions& options,
                std::optional<ReplayMode> feed) {
  Excerpt part;
  std::size_t offset = 0;
  for (std::size_t e = 0; e < whole.size(); ++e) {
    if (e > 0 && seconds < options.shortest_excerpt) break;
    ReplayScope scope;
    scope.bin = whole[e]->bin();
    scope.hidden_inertia = whole[e]->hidden_inertia();
    scope.mode = feed;
    scope.seconds =
        std::max(options.shortest_excerpt, seconds / static_cast<double>(whole.size() - e));
    part.experiments.push_back(scope.seconds < whole[e]->duration()
                                   ? make_experiment(model, recordings[e], options, scope)
                                   : whole[e]);
    const Experiment& own = *part.experiments.back();
    for (std::size_t c = 0; c < own.channels().size(); ++c) {
      const std::size_t from = offset + whole[e]->channels()[c].offset;
      for (std::size_t b = 0; b < own.channels()[c].count; ++b) {
        part.rows.push_back(static_cast<Eigen::Index>(from + b));
      }
    }
    offset += whole[e]->size();
    seconds -= own.duration();
  }
  return part;
}

}  // namespace discovery
}  // namespace anthrob
