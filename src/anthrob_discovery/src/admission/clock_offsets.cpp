#include "admission/clock_offsets.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "admission/movement.h"
#include "anthrob_recording/orientation_series.h"

namespace anthrob {
namespace discovery {

namespace {

/// Rates of several quantities, one column each, by bin of time; in units of their root mean
/// square.
struct Rates {
  /// @param width of a bin [s]
  Rates(Eigen::Index bins, double width)
      : values(bins, 0), known(static_cast<std::size_t>(bins), 1), bin_width(width) {}

  Eigen::MatrixXd values;
  std::vector<char> known;  ///< whether all of them are
  double bin_width;         ///< [s]

  void add(const Series& series) {
    const Eigen::Index bins = values.rows();
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(bins), count = sum;
    for (std::size_t i = 0; i < series.t.size(); ++i) {
      const auto bin = static_cast<Eigen::Index>(series.t[i] / bin_width + 1e-9);
      if (bin >= bins) break;
      sum[bin] += series.values[i] - series.values.front();
      count[bin] += 1.0;
    }
    Eigen::VectorXd rate = Eigen::VectorXd::Zero(bins);
    known.front() = known.back() = 0;
    for (Eigen::Index b = 1; b + 1 < bins; ++b) {
      if (count[b - 1] > 0.0 && count[b + 1] > 0.0) {
        rate[b] = sum[b + 1] / count[b + 1] - sum[b - 1] / count[b - 1];
      } else {
        known[static_cast<std::size_t>(b)] = 0;
      }
    }
    const double rms = rate.norm() / std::sqrt(static_cast<double>(bins));
    if (!(rms > 0.0)) return;
    values.conservativeResize(Eigen::NoChange, values.cols() + 1);
    values.rightCols<1>() = rate / rms;
  }
};

/// Every second fold of the time: the sums of which a regression is made.
struct Half {
  Eigen::MatrixXd gram, cross;
  double squares = 0.0;
};

Half half_of(const Rates& muscles, const Rates& joints, Eigen::Index lag, int which,
             const ClockOptions& options) {
  std::vector<Eigen::Index> rows, late;
  for (Eigen::Index b = 0; b < muscles.values.rows(); ++b) {
    const auto fold = static_cast<int>(static_cast<double>(b) * options.bin / options.fold + 1e-9);
    if (fold % 2 != which || b + lag < 0 || b + lag >= joints.values.rows()) continue;
    if (!muscles.known[static_cast<std::size_t>(b)] ||
        !joints.known[static_cast<std::size_t>(b + lag)]) {
      continue;
    }
    rows.push_back(b);
    late.push_back(b + lag);
  }
  if (static_cast<Eigen::Index>(rows.size()) < 2 * muscles.values.cols()) return {};
  const Eigen::MatrixXd x = muscles.values(rows, Eigen::all), y = joints.values(late, Eigen::all);
  return {x.transpose() * x, x.transpose() * y, y.squaredNorm()};
}

/// Squares that a regression to one half leaves in the other.
double left_of(const Half& half, const Half& other, const ClockOptions& options) {
  Eigen::MatrixXd gram = half.gram;
  gram.diagonal() = (1.0 + options.ridge) * gram.diagonal().array() + 1e-9;
  const Eigen::MatrixXd weights = gram.ldlt().solve(half.cross);
  return other.squares - 2.0 * weights.cwiseProduct(other.cross).sum() +
         weights.cwiseProduct(other.gram * weights).sum();
}

/// @param lag by how many bins joints are late
std::optional<double> explained(const Rates& muscles, const Rates& joints, Eigen::Index lag,
                                const ClockOptions& options) {
  const Half even = half_of(muscles, joints, lag, 0, options),
             odd = half_of(muscles, joints, lag, 1, options);
  if (even.gram.size() == 0 || odd.gram.size() == 0) return {};
  const double squares = even.squares + odd.squares;
  if (!(squares > 0.0)) return {};
  return 1.0 - (left_of(even, odd, options) + left_of(odd, even, options)) / squares;
}

/// Number of seconds over which the squares of the joints' velocities are spread.
double movements(const Rates& joints) {
  std::map<int, double> power;
  for (Eigen::Index b = 0; b < joints.values.rows(); ++b) {
    if (!joints.known[static_cast<std::size_t>(b)]) continue;
    power[static_cast<int>(static_cast<double>(b) * joints.bin_width + 1e-9)] +=
        joints.values.row(b).squaredNorm();
  }
  double sum = 0.0, squares = 0.0;
  for (const auto& [second, own] : power) {
    sum += own;
    squares += own * own;
  }
  return squares > 0.0 ? sum * sum / squares : 0.0;
}

struct Fit {
  double lag = 0.0;       ///< by how much joints are late [s]
  double share = -1e300;  ///< of their squares that is explained
};

Fit best_of(const std::vector<Fit>& fits, double from, double to) {
  Fit best;
  for (const Fit& fit : fits) {
    const double size = std::abs(fit.lag);
    if (size > from + 1e-9 && size <= to + 1e-9 && fit.share > best.share) best = fit;
  }
  return best;
}

/// Series of the joints that move, by the table that they are in. Tables with muscles have their
/// clock.
std::map<std::string, std::vector<Series>> moving_joints(const RobotModel& robot,
                                                         const Dataset& recording,
                                                         const AdmissionOptions& options) {
  std::map<std::string, std::vector<Series>> moving;
  const auto add = [&](const std::string& column, const Series& series) {
    if (!moves(series, options.clocks.least_turn, options.movement)) return;
    for (const Table& table : recording.tables) {
      if (table.name == "commands" || !table.find(column)) continue;
      const bool has_muscles =
          std::any_of(table.columns.begin(), table.columns.end(),
                      [&](const Column& other) { return robot.find_muscle(other.owner()) >= 0; });
      if (!has_muscles) moving[table.name].push_back(series);
    }
  };
  for (const JointModel& joint : robot.skeleton->joints) {
    if (joint.type != JointType::kBall) {
      add(joint.name + "/position", recording.series(joint.name + "/position"));
      continue;
    }
    const OrientationSeries turns = OrientationSeries::read(recording, joint.name);
    const char* const parts[] = {"/w", "/x", "/y", "/z"};
    for (int k = 0; k < 4; ++k) add(joint.name + parts[k], turns.number[k]);
  }
  return moving;
}

/// Positions and forces of the muscles of which both are measured.
std::vector<Series> moving_muscles(const RobotModel& robot, const Dataset& recording,
                                   const AdmissionOptions& options) {
  std::vector<Series> moving;
  for (const MuscleModel& muscle : robot.muscles) {
    const Series position = recording.series(muscle.name + "/position"),
                 force = recording.series(muscle.name + "/force");
    if (position.empty() || force.empty()) continue;
    if (moves(position, options.clocks.least_turn, options.movement)) moving.push_back(position);
    if (moves(force, options.clocks.least_force, options.movement)) moving.push_back(force);
  }
  return moving;
}

std::optional<ClockOffset> offset_of(const Rates& muscles, const Rates& joints, double length,
                                     const ClockOptions& options) {
  const double spread = movements(joints);
  if (spread < options.few_movements) return {};
  const auto reach = static_cast<Eigen::Index>(
      std::min(options.longest_lag, options.share_of_time * length) / options.bin + 1e-9);
  std::vector<Fit> fits;
  for (Eigen::Index lag = -reach; lag <= reach; ++lag) {
    const auto share = explained(muscles, joints, lag, options);
    if (share) fits.push_back({static_cast<double>(lag) * options.bin, *share});
  }
  const Fit best = best_of(fits, options.plausible, options.longest_lag);
  const double near = std::max(0.0, best_of(fits, -1.0, options.plausible).share);
  if (best.share < options.explains || 1.0 - best.share > options.clearly * (1.0 - near)) return {};
  return ClockOffset{{}, best.lag, best.share, near, spread >= options.several_movements};
}

}  // namespace

std::vector<ClockOffset> clock_offsets(const RobotModel& robot, const Dataset& recording,
                                       const AdmissionOptions& options) {
  const std::vector<Series> acting = moving_muscles(robot, recording, options);
  if (acting.empty()) return {};
  const auto moving = moving_joints(robot, recording, options);
  const double length = seconds(recording.end() - recording.begin());
  const double work = options.clocks.most_work / static_cast<double>(acting.size() * acting.size());
  const auto bins =
      static_cast<Eigen::Index>(std::min({std::floor(length / options.clocks.bin) + 1.0, work,
                                          static_cast<double>(options.clocks.most_bins)}));
  if (bins < 3) return {};
  Rates muscles(bins, options.clocks.bin);
  for (const Series& series : acting) muscles.add(series);
  std::vector<ClockOffset> offsets;
  for (const auto& [table, series] : moving) {
    Rates joints(bins, options.clocks.bin);
    for (const Series& own : series) joints.add(own);
    auto offset =
        offset_of(muscles, joints, static_cast<double>(bins) * options.clocks.bin, options.clocks);
    if (!offset) continue;
    offset->table = table;
    offsets.push_back(*offset);
  }
  return offsets;
}

}  // namespace discovery
}  // namespace anthrob
