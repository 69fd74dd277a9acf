#include "experiment/excerpt.h"

#include <algorithm>

namespace anthrob {
namespace discovery {

namespace {

/// Shortest part of a recording: settling takes longer than simulating a shorter one.
constexpr double kShortest = 2.0;  // [s]

}  // namespace

Excerpt excerpt(const RobotModel& model, const std::vector<Dataset>& recordings,
                const Experiments& whole, double seconds) {
  Excerpt part;
  std::size_t offset = 0;
  for (std::size_t e = 0; e < whole.size(); ++e) {
    if (e > 0 && seconds < kShortest) break;
    ExperimentOptions options;
    options.bin = whole[e]->bin();
    options.seconds = std::max(kShortest, seconds / static_cast<double>(whole.size() - e));
    part.experiments.push_back(options.seconds < whole[e]->duration()
                                   ? make_experiment(model, recordings[e], options)
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
