#include "anthrob_calib/discovery/examples.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace discovery {

namespace {

constexpr std::size_t kMost = 3;

/// Most change first; where nothing changed, the largest gap.
std::vector<std::string> by_change(const std::map<std::string, Gap>& gaps) {
  std::vector<std::pair<double, std::string>> order;
  for (const auto& [name, gap] : gaps) {
    order.emplace_back(-std::abs(gap.recalibrated - gap.after) - 1e-3 * gap.recalibrated, name);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::string> names;
  for (const auto& [change, name] : order) names.push_back(name);
  return names;
}

}  // namespace

std::vector<Example> examples_of(const Experiment& experiment, const Eigen::VectorXf& whitener,
                                 const Eigen::VectorXf& recalibrated, const Eigen::VectorXf& after,
                                 const std::map<std::string, Gap>& gaps) {
  std::vector<std::string> names = by_change(gaps);
  if (names.size() > kMost) names.resize(kMost);
  std::vector<Example> examples;
  for (const std::string& name : names) {
    const auto& channels = experiment.channels();
    const auto channel = std::find_if(channels.begin(), channels.end(),
                                      [&](const Channel& c) { return c.name() == name; });
    if (channel == channels.end()) continue;
    Example example{name, channel->unit, {}, {}, {}};
    for (std::size_t b = 0; b < channel->count; ++b) {
      const auto k = static_cast<Eigen::Index>(channel->offset + b);
      const double factor = whitener[k];
      if (!(factor > 0.0)) continue;
      example.t.push_back(experiment.bin_time(b));
      example.recalibrated.push_back(recalibrated[k] / factor);
      example.after.push_back(after[k] / factor);
    }
    examples.push_back(std::move(example));
  }
  return examples;
}

}  // namespace discovery
}  // namespace anthrob
