#include "experiment/noise_floor.h"

#include <algorithm>
#include <cmath>

#include "anthrob_core/errors.h"
#include "anthrob_recording/resolution.h"

namespace anthrob {
namespace discovery {

namespace {

/// Sums of squares of a channel, over its components and experiments.
struct Moments {
  double squares = 0.0;
  double count = 0.0;
  double rms() const { return count > 0.0 ? std::sqrt(squares / count) : 0.0; }
};

template <typename Visit>
void for_each_channel(const Experiments& experiments, Visit visit) {
  std::size_t offset = 0;
  for (const auto& experiment : experiments) {
    for (const Channel& channel : experiment->channels()) {
      visit(*experiment, channel, static_cast<Eigen::Index>(offset + channel.offset));
    }
    offset += experiment->size();
  }
}

/// Values of a channel in the bins that are marked.
Eigen::VectorXf marked(const std::vector<char>& marks, const Channel& channel,
                       const Eigen::VectorXf& values, Eigen::Index offset) {
  std::vector<float> found;
  for (std::size_t b = 0; b < channel.count; ++b) {
    if (marks[channel.offset + b]) {
      found.push_back(values[offset + static_cast<Eigen::Index>(b)]);
    }
  }
  return Eigen::Map<Eigen::VectorXf>(found.data(), static_cast<Eigen::Index>(found.size()));
}

/// Where a channel was measured.
Eigen::VectorXf measured(const Experiment& experiment, const Channel& channel,
                         const Eigen::VectorXf& values, Eigen::Index offset) {
  return marked(experiment.present(), channel, values, offset);
}

/// Root mean square of differences between repeats, some of which may be larger than noise makes
/// them: a motion that turns back a moment later meets friction of the other sign.
double rms_of_repeats(std::vector<float> differences, const ExperimentOptions& options) {
  const auto rms = [](const std::vector<float>& values, std::size_t count) {
    double squares = 0.0;
    for (std::size_t i = 0; i < count; ++i) squares += double(values[i]) * values[i];
    return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0.0;
  };
  std::sort(differences.begin(), differences.end(),
            [](float a, float b) { return std::abs(a) < std::abs(b); });
  const auto count = static_cast<double>(differences.size());
  const auto most =
      static_cast<std::size_t>(count - std::floor(options.torn_repeats.value * count));
  return std::min(rms(differences, differences.size()),
                  options.normal_tails * rms(differences, most));
}

/// Whether a channel is of a sensor whose resolution the controllers see (Variant).
bool is_counted(const RobotModel& robot, const Channel& channel) {
  return robot.find_muscle(channel.place) >= 0 &&
         (channel.quantity == "position" || channel.quantity == "force");
}

/// The given model with the coarsest counts that motor positions and forces were recorded with.
Variant with_counts(const RobotModel& robot, const Experiments& experiments) {
  Variant variant{};
  for (const Channel& channel : channels_of(experiments)) {
    if (!is_counted(robot, channel)) continue;
    double& count = channel.quantity == "force" ? variant.force_count : variant.position_count;
    count = std::max(count, channel.resolution);
  }
  return variant;
}

void from_repeats(const Evaluator& evaluator, const Experiments& train, const Experiments& repeats,
                  const std::vector<long>& lags, const ExperimentOptions& options, Scales& scales) {
  const Experiment& first = *train.front();
  const Variant given{};
  const Differences base = evaluator.compare({given}, {train.front()}).front();
  std::map<std::string, Moments> moments;
  std::map<std::string, std::vector<float>> lacking;  // efforts of driven joints
  std::map<std::string, std::vector<double>> lengths;
  std::map<std::string, double> averaged;  // bins, each divided by its measurements
  for (std::size_t r = 0; r < repeats.size(); ++r) {
    const auto& repeat = repeats[r];
    const long lag = lags.empty() ? 0 : lags[r];
    const Differences other = evaluator.compare({given}, {repeat}).front();
    if (base.size() == 0 || other.size() == 0) {
      throw std::runtime_error("the model cannot be simulated with the inputs of " +
                               repeat->name() +
                               ": replay it with anthrob_replay to see where it fails");
    }
    if (repeat->channels().size() != first.channels().size()) {
      throw BadInput(repeat->name() + ": expected the same measured columns as in " + first.name() +
                     ", whose commands it repeats");
    }
    for (std::size_t c = 0; c < first.channels().size(); ++c) {
      const Channel &a = first.channels()[c], &b = repeat->channels()[c];
      if (a.name() != b.name()) {
        throw BadInput(repeat->name() + ": expected the same measured columns as in " +
                       first.name() + ", whose commands it repeats");
      }
      const long begin = std::max(0L, -lag);
      const long end = std::min(static_cast<long>(a.count), static_cast<long>(b.count) - lag);
      std::vector<float> both;  // where both were measured
      for (long i = begin; i < end; ++i) {
        const auto k = a.offset + static_cast<std::size_t>(i);
        const auto l = b.offset + static_cast<std::size_t>(i + lag);
        if (!first.telling()[k] || !repeat->telling()[l]) continue;
        both.push_back((base[static_cast<Eigen::Index>(k)] - other[static_cast<Eigen::Index>(l)]) /
                       std::sqrt(2.0f));
        moments[a.name()].squares += double(both.back()) * both.back();
        moments[a.name()].count += 1.0;
        if (a.quantity == "effort") lacking[a.name()].push_back(both.back());
        averaged[a.name()] += 0.5 / a.rows + 0.5 / b.rows;
      }
      lengths[a.name()].push_back(correlation_length(
          Eigen::Map<Eigen::VectorXf>(both.data(), static_cast<Eigen::Index>(both.size()))));
    }
  }
  for (auto& [name, scale] : scales) {
    if (!moments.count(name)) continue;
    scale.floor =
        lacking.count(name) ? rms_of_repeats(lacking[name], options) : moments[name].rms();
    if (averaged[name] > 0.0) scale.rows = moments[name].count / averaged[name];
    double mean = 0.0;
    for (const double length : lengths[name]) mean += length;
    scale.inflation = std::max(1.0, mean / static_cast<double>(lengths[name].size()));
  }
}

}  // namespace

double ChannelScale::sigma(double rows_of_recording) const {
  const double fewer = rows / rows_of_recording;
  return std::hypot(fewer > fewer_rows ? floor * std::sqrt(fewer) : floor, numerics, counts);
}

double correlation_length(const Eigen::VectorXf& series) {
  const auto n = series.size();
  if (n < 8) return 1.0;
  const Eigen::VectorXd centred = (series.array() - series.mean()).cast<double>();
  const double variance = centred.squaredNorm();
  if (!(variance > 0.0)) return 1.0;
  double length = 1.0;
  for (Eigen::Index lag = 1; lag < n / 4; ++lag) {
    const double r = centred.head(n - lag).dot(centred.tail(n - lag)) / variance;
    if (r < 2.0 / std::sqrt(static_cast<double>(n))) break;
    length += 2.0 * r;
  }
  return length;
}

Scales measure_scales(const Evaluator& evaluator, const Experiments& train,
                      const Experiments& repeats, const std::vector<long>& lags,
                      const ExperimentOptions& options) {
  Variant half{};
  half.step = 0.5 * evaluator.model()->step;
  const Variant counting = with_counts(*evaluator.model(), train);
  const auto both = evaluator.compare({Variant{}, half, counting}, train);
  if (both[0].size() == 0) {
    throw std::runtime_error(
        "the given model cannot be simulated with the inputs of the recordings: replay them with "
        "anthrob_replay to see where it fails");
  }
  Scales scales;
  std::map<std::string, Moments> numerics, counts, noise;
  std::map<std::string, double> averaged;  // bins, each divided by its measurements
  for_each_channel(
      train, [&](const Experiment& experiment, const Channel& channel, Eigen::Index offset) {
        scales[channel.name()].unit = channel.unit;
        scales[channel.name()].fewer_rows = options.fewer_rows;
        const auto own = measured(experiment, channel, both[0], offset);
        const double sigma = white_noise(marked(experiment.telling(), channel, both[0], offset));
        noise[channel.name()].squares += sigma * sigma * static_cast<double>(own.size());
        noise[channel.name()].count += static_cast<double>(own.size());
        averaged[channel.name()] += static_cast<double>(own.size()) / channel.rows;
        const auto add_change = [&](const Differences& other, Moments& moments) {
          if (other.size() == 0) return;
          const auto changed = measured(experiment, channel, other, offset);
          moments.squares += (changed - own).cast<double>().squaredNorm();
          moments.count += static_cast<double>(own.size());
        };
        add_change(both[1], numerics[channel.name()]);
        add_change(both[2], counts[channel.name()]);
      });
  for (auto& [name, scale] : scales) {
    scale.numerics = numerics[name].rms();
    scale.counts = counts[name].rms();
    scale.floor = noise[name].rms();
    if (averaged[name] > 0.0) scale.rows = noise[name].count / averaged[name];
  }
  if (!repeats.empty()) from_repeats(evaluator, train, repeats, lags, options, scales);
  std::map<std::string, double> roundings, counted;  // of its sensor; where controllers see it
  for (const auto& experiment : train) {
    for (const Channel& channel : experiment->channels()) {
      double& largest = roundings[channel.name()];
      largest = std::max(largest, std::max(channel.resolution, channel.digits) / std::sqrt(12.0));
      if (is_counted(*evaluator.model(), channel)) counted[channel.name()] = largest;
    }
  }
  for (auto& [name, scale] : scales) {
    scale.floor = std::max(scale.floor, roundings[name]);
    // What a sensor rounds itself is in its floor.
    scale.counts =
        std::sqrt(std::max(0.0, scale.counts * scale.counts - counted[name] * counted[name]));
  }
  for (auto& [name, scale] : scales) {
    if (!(scale.sigma() > 0.0)) scale.floor = 1e-9;
  }
  return scales;
}

Eigen::VectorXf whitener(const Experiments& experiments, const Scales& scales, bool independent) {
  Eigen::VectorXf factors =
      Eigen::VectorXf::Zero(static_cast<Eigen::Index>(total_size(experiments)));
  for_each_channel(
      experiments, [&](const Experiment& experiment, const Channel& channel, Eigen::Index offset) {
        const auto found = scales.find(channel.name());
        if (found == scales.end()) return;
        const ChannelScale& scale = found->second;
        const double factor =
            1.0 / (scale.sigma(channel.rows) * (independent ? std::sqrt(scale.inflation) : 1.0));
        for (std::size_t b = 0; b < channel.count; ++b) {
          if (experiment.present()[channel.offset + b]) {
            factors[offset + static_cast<Eigen::Index>(b)] = static_cast<float>(factor);
          }
        }
      });
  return factors;
}

}  // namespace discovery
}  // namespace anthrob
