#include "diagnosis/examples.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace anthrob {
namespace discovery {

namespace {

/// Largest change first; among unchanged channels, the largest gap.
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

/// The component of a channel that changes most: an orientation has three.
const Channel* most_changed(const Experiment& experiment, const std::string& name,
                            const Eigen::VectorXf& recalibrated, const Eigen::VectorXf& after) {
  const Channel* found = nullptr;
  double most = -1.0;
  for (const Channel& channel : experiment.channels()) {
    if (channel.name() != name) continue;
    const auto from = static_cast<Eigen::Index>(channel.offset),
               count = static_cast<Eigen::Index>(channel.count);
    const auto one = recalibrated.segment(from, count), other = after.segment(from, count);
    const double change = (one - other).squaredNorm() + 1e-6 * one.squaredNorm();
    if (change <= most) continue;
    most = change;
    found = &channel;
  }
  return found;
}

std::string label_of(const Channel& channel) {
  if (channel.quantity != "orientation") return channel.name();
  return channel.name() + "/" + "xyz"[channel.component];
}

/// Mean in the bin, with which simulations were compared.
double mean_in(const Series& series, double begin, double end) {
  const auto first = std::lower_bound(series.t.begin(), series.t.end(), begin);
  const auto last = std::lower_bound(first, series.t.end(), end);
  if (first == last) return series.at(0.5 * (begin + end));
  const auto value = series.values.begin();
  return std::accumulate(value + (first - series.t.begin()), value + (last - series.t.begin()),
                         0.0) /
         static_cast<double>(last - first);
}

}  // namespace

std::vector<Example> examples_of(const Experiment& experiment, const Dataset& recording,
                                 const Eigen::VectorXf& whitener,
                                 const Eigen::VectorXf& recalibrated, const Eigen::VectorXf& after,
                                 const std::map<std::string, Gap>& gaps, std::size_t most) {
  std::vector<std::string> names = by_change(gaps);
  if (names.size() > most) names.resize(most);
  std::vector<Example> examples;
  for (const std::string& name : names) {
    const Channel* channel = most_changed(experiment, name, recalibrated, after);
    if (!channel) continue;
    Example example{label_of(*channel), channel->unit, {}, {}, {}, {}};
    const Series measured = recording.series(channel->column());
    for (std::size_t b = 0; b < channel->count; ++b) {
      const auto k = static_cast<Eigen::Index>(channel->offset + b);
      const double factor = whitener[k];
      if (!(factor > 0.0)) continue;
      example.t.push_back(experiment.bin_time(b));
      example.recalibrated.push_back(recalibrated[k] / factor);
      example.after.push_back(after[k] / factor);
      if (measured.empty()) continue;
      const double begin = static_cast<double>(b) * experiment.bin();
      example.measured.push_back(mean_in(measured, begin, begin + experiment.bin()));
    }
    examples.push_back(std::move(example));
  }
  return examples;
}

}  // namespace discovery
}  // namespace anthrob
