#include "measurement/controlled_muscles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "anthrob_core/random.h"
#include "anthrob_recording/resolution.h"
#include "anthrob_sim/replay/replay.h"

namespace anthrob {
namespace discovery {

namespace {

double squared_noise(const std::vector<double>& values) {
  const Eigen::Map<const Eigen::VectorXd> all(values.data(),
                                              static_cast<Eigen::Index>(values.size()));
  const double noise = white_noise((all.array() - all.mean()).matrix().cast<float>());
  return noise * noise;
}

/// Central differences, where no velocity was measured.
Series velocity_of(const Series& series) {
  Series rate = series;
  const std::size_t n = series.t.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t from = i > 0 ? i - 1 : 0, to = std::min(i + 1, n - 1);
    rate.values[i] =
        to > from ? (series.values[to] - series.values[from]) / (series.t[to] - series.t[from])
                  : 0.0;
  }
  return rate;
}

/// From the nearest row [s].
double away_from(const Series& series, double time) {
  const auto next = std::lower_bound(series.t.begin(), series.t.end(), time);
  const double after = next == series.t.end() ? HUGE_VAL : *next - time,
               before = next == series.t.begin() ? HUGE_VAL : time - *std::prev(next);
  return std::min(before, after);
}

}  // namespace

Interpolated interpolated(const Series& series, double time) {
  const auto next = std::upper_bound(series.t.begin(), series.t.end(), time + 1e-9);
  if (next == series.t.begin()) return {series.values.front(), 1.0};
  const auto i = static_cast<std::size_t>(next - series.t.begin());
  if (i == series.t.size()) return {series.values.back(), 1.0};
  const double share = std::max(0.0, (time - series.t[i - 1]) / (series.t[i] - series.t[i - 1]));
  return {series.values[i - 1] + share * (series.values[i] - series.values[i - 1]),
          (1.0 - share) * (1.0 - share) + share * share};
}

double sum_of(const std::vector<double>& squares) {
  return std::accumulate(squares.begin(), squares.end(), 0.0);
}

ControlledMuscles::ControlledMuscles(const RobotModel& robot,
                                     const std::vector<const Dataset*>& recordings,
                                     const ControllerAlgebraOptions& options)
    : options_(options) {
  const std::size_t parts = std::max<std::size_t>(1, robot.muscles.size() * recordings.size());
  for (const Dataset* recording : recordings) {
    const double length = seconds(recording->end() - recording->begin());
    first_blocks_.push_back(noise_.size());
    noise_.resize(noise_.size() + static_cast<std::size_t>(length / options.block), 0.0);
    if (noise_.size() == first_blocks_.back()) continue;
    for (const MuscleModel& muscle : robot.muscles) {
      add(muscle, *recording, std::max<std::size_t>(1, options.most_rows / parts));
    }
  }
  first_blocks_.push_back(noise_.size());
}

void ControlledMuscles::add(const MuscleModel& muscle, const Dataset& recording,
                            std::size_t most_rows) {
  if (!muscle.has_controller) return;
  ControlledMuscle own;
  own.name = muscle.name;
  own.gains = muscle.controller.position;
  own.voltage = recording.series(muscle.name + "/voltage");
  own.position = recording.series(muscle.name + "/position");
  if (own.voltage.t.size() < 10 || own.position.t.size() < 10) return;
  const CommandSeries followed = followed_commands(recording, muscle.name, ecu::Mode::kPosition);
  own.reference = followed.reference;
  const auto is_position = [](double mode) {
    return mode == static_cast<double>(ecu::Mode::kPosition);
  };
  if (own.reference.empty() ||
      !std::all_of(followed.mode.values.begin(), followed.mode.values.end(), is_position)) {
    return;
  }
  own.velocity = recording.series(muscle.name + "/velocity");
  if (own.velocity.t.size() < 10) own.velocity = velocity_of(own.position);
  own.force = recording.series(muscle.name + "/force");
  const double limit = options_.clipped * muscle.controller.voltage_limit;
  const double longest =
      std::max(options_.longest, options_.longest_latency) + muscle.controller.period;
  const double from = std::max(own.position.t.front(), own.reference.t.front()) + longest,
               to = own.position.t.back() - longest;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < own.voltage.t.size(); ++i) {
    const double t = own.voltage.t[i];
    if (!(t > from && t < to && std::abs(own.voltage.values[i]) < limit)) continue;
    // Far from a measured position, interpolation leaves more than another tick does.
    if (away_from(own.position, t - muscle.controller.period) > options_.beside) continue;
    rows.push_back(i);
  }
  // By chance: of regular rows, commands may fall on all or on none.
  const CounterRandom random(1, 17);
  const double share = static_cast<double>(most_rows) / static_cast<double>(rows.size() + 1);
  for (const std::size_t row : rows) {
    if (random.uniform(row) < share) own.rows.push_back(row);
  }
  if (own.rows.size() < 10) return;
  const double noise = squared_noise(own.voltage.values);
  if (!(noise > 0.0)) return;
  own.voltage_noise = noise;
  own.weight = 1.0 / (noise * static_cast<double>(own.rows.size()));
  own.position_noise = squared_noise(own.position.values);
  own.velocity_noise = squared_noise(own.velocity.values);
  own.force_noise = own.force.empty() ? 0.0 : squared_noise(own.force.values);
  const double per_row = own.weight * own.noise(own.gains, 1.0, 1.0);
  own.first_block = first_blocks_.back();
  own.last_block = noise_.size() - 1;
  for (const std::size_t row : own.rows) noise_[own.block_of(row, options_.block)] += per_row;
  tick_ = std::max(tick_, muscle.controller.period);
  muscles_.push_back(std::move(own));
}

std::size_t ControlledMuscle::block_of(std::size_t row, double length) const {
  return std::min(first_block + static_cast<std::size_t>(voltage.t[row] / length), last_block);
}

double ControlledMuscle::noise(const ecu::PositionGains& of, double position_variance,
                               double force_variance) const {
  return (of.proportional * of.proportional * position_noise +
          of.derivative * of.derivative * velocity_noise) *
             position_variance +
         of.force_feedforward * of.force_feedforward * force_noise * force_variance;
}

double ControlledMuscles::sureness(const Squares& first, const Squares& second) const {
  std::vector<double> ratios;
  for (std::size_t b = 0; b < noise_.size(); ++b) {
    if (!(noise_[b] > 0.0)) continue;
    const double least = 1e-3 * noise_[b];
    ratios.push_back(
        std::log(std::max(least, first[b] + noise_[b]) / std::max(least, second[b] + noise_[b])));
  }
  if (ratios.size() < options_.fewest_blocks) return 0.0;
  const auto n = static_cast<double>(ratios.size());
  const double mean = sum_of(ratios) / n;
  double square = 0.0;
  for (const double ratio : ratios) square += (ratio - mean) * (ratio - mean);
  const double error = std::sqrt(square / (n * (n - 1.0)));
  return error > 0.0 ? mean / error : 0.0;
}

double ControlledMuscles::left(const Squares& squares) const {
  return std::sqrt(std::max(0.0, sum_of(squares)) / static_cast<double>(muscles_.size()));
}

}  // namespace discovery
}  // namespace anthrob
