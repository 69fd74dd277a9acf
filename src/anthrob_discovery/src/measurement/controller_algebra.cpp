#include "measurement/controller_algebra.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "anthrob_core/random.h"
#include "anthrob_recording/resolution.h"
#include "anthrob_sim/replay/replay.h"

namespace anthrob {
namespace discovery {

namespace {

/// A value between two rows.
struct Interpolated {
  double value;
  double variance;  ///< of it, for rows with independent noise of variance 1
};

Interpolated interpolated(const Series& series, double time) {
  const auto next = std::upper_bound(series.t.begin(), series.t.end(), time + 1e-9);
  if (next == series.t.begin()) return {series.values.front(), 1.0};
  const auto i = static_cast<std::size_t>(next - series.t.begin());
  if (i == series.t.size()) return {series.values.back(), 1.0};
  const double share = std::max(0.0, (time - series.t[i - 1]) / (series.t[i] - series.t[i - 1]));
  return {series.values[i - 1] + share * (series.values[i] - series.values[i - 1]),
          (1.0 - share) * (1.0 - share) + share * share};
}

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

double sum_of(const std::vector<double>& squares) {
  return std::accumulate(squares.begin(), squares.end(), 0.0);
}

/// Squares by block, at shifts of whole ticks.
struct Scan {
  long first;  ///< [ticks]
  std::vector<std::vector<double>> squares;

  /// The index that leaves least without one block; with all blocks: pass their number.
  std::size_t best(std::size_t without) const {
    const auto left = [&](std::size_t at) {
      return sum_of(squares[at]) - (without < squares[at].size() ? squares[at][without] : 0.0);
    };
    std::size_t best = 0;
    for (std::size_t i = 1; i < squares.size(); ++i) {
      if (left(i) < left(best)) best = i;
    }
    return best;
  }
  /// Of the best index, by the jackknife over blocks [ticks].
  double error() const {
    const std::size_t n = squares.front().size();
    const auto whole = static_cast<double>(best(n));
    double square = 0.0;
    for (std::size_t b = 0; b < n; ++b) {
      square += std::pow(static_cast<double>(best(b)) - whole, 2);
    }
    return std::sqrt(square * static_cast<double>(n - 1) / static_cast<double>(n));
  }
};

}  // namespace

ControllerAlgebra::ControllerAlgebra(const RobotModel& robot,
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

void ControllerAlgebra::add(const MuscleModel& muscle, const Dataset& recording,
                            std::size_t most_rows) {
  if (!muscle.has_controller) return;
  Muscle own;
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
  const double longest = options_.longest + muscle.controller.period;
  const double from = std::max(own.position.t.front(), own.reference.t.front()) + longest,
               to = own.position.t.back() - longest;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < own.voltage.t.size(); ++i) {
    const double t = own.voltage.t[i];
    if (t > from && t < to && std::abs(own.voltage.values[i]) < limit) rows.push_back(i);
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

std::size_t ControllerAlgebra::Muscle::block_of(std::size_t row, double length) const {
  return std::min(first_block + static_cast<std::size_t>(voltage.t[row] / length), last_block);
}

double ControllerAlgebra::Muscle::noise(const ecu::PositionGains& of, double position_variance,
                                        double force_variance) const {
  return (of.proportional * of.proportional * position_noise +
          of.derivative * of.derivative * velocity_noise) *
             position_variance +
         of.force_feedforward * of.force_feedforward * force_noise * force_variance;
}

ControllerAlgebra::Shifts ControllerAlgebra::shifts(LateStamp what, double late) const {
  Shifts all{tick_, tick_, tick_};
  // A voltage that is stamped late is due to what was earlier; of what is stamped late itself, the
  // controller knew what the recording has only later.
  switch (what) {
    case LateStamp::kVoltage:
      return {tick_ + late, tick_ + late, tick_ + late};
    case LateStamp::kPosition:
      all.position -= late;
      break;
    case LateStamp::kForce:
      all.force -= late;
      break;
    case LateStamp::kReference:
      all.reference -= late;
      break;
    case LateStamp::kMeasured:
      all.position -= late;
      all.force -= late;
      break;
  }
  return all;
}

ControllerAlgebra::Squares ControllerAlgebra::squares(const Shifts& shifts) const {
  Squares squares(noise_.size(), 0.0);
  for (const Muscle& muscle : muscles_) {
    const ecu::PositionGains& gains = muscle.gains;
    for (const std::size_t row : muscle.rows) {
      const double t = muscle.voltage.t[row];
      const Interpolated position = interpolated(muscle.position, t - shifts.position),
                         velocity = interpolated(muscle.velocity, t - shifts.position);
      double expected =
          gains.proportional *
              (muscle.reference.held_at(t - shifts.reference + 1e-9) - position.value) -
          gains.derivative * velocity.value;
      double force_variance = 0.0;
      if (!muscle.force.empty()) {
        const Interpolated force = interpolated(muscle.force, t - shifts.force);
        expected += gains.force_feedforward * force.value;
        force_variance = force.variance;
      }
      const double left = muscle.voltage.values[row] - expected;
      squares[muscle.block_of(row, options_.block)] +=
          muscle.weight * (left * left - muscle.noise(gains, position.variance, force_variance));
    }
  }
  return squares;
}

ControllerAlgebra::Squares ControllerAlgebra::squares_of_free_gains() const {
  Squares squares(noise_.size(), 0.0);
  for (const Muscle& muscle : muscles_) {
    const auto n = static_cast<Eigen::Index>(muscle.rows.size());
    Eigen::MatrixX4d terms(n, 4);
    Eigen::VectorXd voltages(n), position_variance(n), force_variance(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const std::size_t row = muscle.rows[static_cast<std::size_t>(i)];
      const double t = muscle.voltage.t[row] - tick_;
      const Interpolated position = interpolated(muscle.position, t);
      const Interpolated force =
          muscle.force.empty() ? Interpolated{0.0, 0.0} : interpolated(muscle.force, t);
      terms.row(i) << muscle.reference.held_at(t + 1e-9) - position.value,
          interpolated(muscle.velocity, t).value, force.value, 1.0;
      voltages[i] = muscle.voltage.values[row];
      position_variance[i] = position.variance, force_variance[i] = force.variance;
    }
    Eigen::Matrix4d gram = terms.transpose() * terms;
    gram.diagonal().array() *= 1.0 + 1e-9;
    gram.diagonal().array() += 1e-12;
    // Noise of the measurements makes gains smaller; what it leaves with them is less, too.
    const Eigen::Vector4d gains = gram.ldlt().solve(terms.transpose() * voltages);
    const Eigen::VectorXd left = voltages - terms * gains;
    const ecu::PositionGains fitted{gains[0], -gains[1], gains[2]};
    for (Eigen::Index i = 0; i < n; ++i) {
      squares[muscle.block_of(muscle.rows[static_cast<std::size_t>(i)], options_.block)] +=
          muscle.weight *
          (left[i] * left[i] - muscle.noise(fitted, position_variance[i], force_variance[i]));
    }
  }
  return squares;
}

double ControllerAlgebra::sureness(const Squares& first, const Squares& second) const {
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

std::optional<StampShift> ControllerAlgebra::stamp_shift() const {
  if (!is_known()) return {};
  struct Cause {
    StampShift shift;
    Squares squares;
  };
  std::vector<Cause> causes;
  const Squares none = squares(shifts(LateStamp::kVoltage, 0.0));
  for (const LateStamp what : {LateStamp::kVoltage, LateStamp::kPosition, LateStamp::kForce,
                               LateStamp::kReference, LateStamp::kMeasured}) {
    const auto reach = static_cast<long>(std::floor(options_.longest / tick_ + 1e-9));
    Scan scan{-reach, {}};
    for (long k = -reach; k <= reach; ++k) {
      scan.squares.push_back(squares(shifts(what, static_cast<double>(k) * tick_)));
    }
    const std::size_t at = scan.best(noise_.size());
    if (at == 0 || at + 1 == scan.squares.size()) continue;  // beyond what sampling does
    const auto ticks = static_cast<double>(scan.first + static_cast<long>(at));
    const double error = std::hypot(scan.error(), 1.0 / std::sqrt(12.0));
    causes.push_back({{what, ticks * tick_, error * tick_, tick_}, scan.squares[at]});
  }
  if (causes.empty()) return {};
  auto best = std::min_element(causes.begin(), causes.end(), [](const Cause& a, const Cause& b) {
    return sum_of(a.squares) < sum_of(b.squares);
  });
  // Where forces hardly matter to the law, nothing says that they are late, too.
  const auto positions = std::find_if(causes.begin(), causes.end(), [](const Cause& cause) {
    return cause.shift.what == LateStamp::kPosition;
  });
  const bool is_measured = best->shift.what == LateStamp::kMeasured;
  if (is_measured && positions != causes.end() &&
      sureness(positions->squares, best->squares) < options_.clearly) {
    best = positions;
  }
  const StampShift& shift = best->shift;
  if (std::abs(shift.late) < 0.5 * tick_) return {};
  if (sureness(none, best->squares) < options_.sure) return {};
  if (sureness(squares_of_free_gains(), best->squares) < options_.clearly) return {};
  for (const Cause& other : causes) {
    const bool is_part =
        best->shift.what == LateStamp::kPosition && other.shift.what == LateStamp::kMeasured;
    if (&other == &*best || is_part) continue;
    if (sureness(other.squares, best->squares) < options_.clearly) return {};
  }
  // Stamps that come before their quantity are a controller that hears of it late.
  if (shift.what != LateStamp::kVoltage && shift.late < 0.0) return {};
  return shift;
}

bool ControllerAlgebra::helps(const StampShift& shift, std::size_t recording) const {
  const Squares without = squares(shifts(LateStamp::kVoltage, 0.0)),
                with = squares(shifts(shift.what, shift.late));
  double gain = 0.0;
  for (std::size_t b = first_blocks_[recording]; b < first_blocks_[recording + 1]; ++b) {
    gain += without[b] - with[b];
  }
  return gain > 0.0;
}

double ControllerAlgebra::left(const std::optional<StampShift>& shift) const {
  if (!is_known()) return 0.0;
  const Squares squares_left =
      squares(shift ? shifts(shift->what, shift->late) : shifts(LateStamp::kVoltage, 0.0));
  return std::sqrt(std::max(0.0, sum_of(squares_left)) / static_cast<double>(muscles_.size()));
}

}  // namespace discovery
}  // namespace anthrob
