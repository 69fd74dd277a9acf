#include "experiment/posture_noise.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>

#include "anthrob_core/random.h"
#include "anthrob_recording/orientation_series.h"
#include "anthrob_recording/resolution.h"
#include "experiment/noise_floor.h"

namespace anthrob {
namespace discovery {

namespace {

using Change = std::function<std::vector<double>(const Series&)>;

double usual_period(const std::vector<double>& t) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < t.size(); ++i) periods.push_back(t[i] - t[i - 1]);
  if (periods.empty()) return 0.0;
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle;
}

/// The value at a row's time of the parabola of least squares through rows [from, to).
double parabola(const Series& series, std::size_t row, std::size_t from, std::size_t to,
                double period) {
  const auto count = static_cast<Eigen::Index>(to - from);
  Eigen::MatrixX3d powers(count, 3);
  Eigen::VectorXd values(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::size_t at = from + static_cast<std::size_t>(i);
    const double x = (series.t[at] - series.t[row]) / period;
    powers.row(i) << 1.0, x, x * x;
    values[i] = series.values[at];
  }
  return powers.colPivHouseholderQr().solve(values)[0];
}

std::vector<double> smoothed(const Series& series, const PostureNoiseOptions& options) {
  std::vector<double> smooth = series.values;
  const std::size_t n = series.t.size();
  const double period = usual_period(series.t), gap = options.longest_gap * period;
  if (!(period > 0.0)) return smooth;
  for (std::size_t row = 0; row < n; ++row) {
    std::size_t from = row, to = row + 1;
    while (from > 0 && row - from < options.reach && series.t[from] - series.t[from - 1] <= gap)
      --from;
    while (to < n && to - row <= options.reach && series.t[to] - series.t[to - 1] <= gap) ++to;
    if (to - from >= options.fewest) smooth[row] = parabola(series, row, from, to, period);
  }
  return smooth;
}

void write(Dataset& recording, const std::string& name, const std::vector<double>& values) {
  std::size_t next = 0;
  for (Table& table : recording.tables) {
    for (Column& column : table.columns) {
      if (column.name != name) continue;
      for (std::size_t i = 0; i < column.values.size() && next < values.size(); ++i) {
        if (column.present[i]) column.values[i] = values[next++];
      }
    }
  }
}

/// Changes all joint positions, each column by itself.
Dataset changed(const RobotModel& robot, Dataset recording, const Change& change) {
  for (const JointModel& joint : robot.skeleton->joints) {
    if (joint.type != JointType::kBall) {
      const std::string name = joint.name + "/position";
      const Series series = recording.series(name);
      if (!series.empty()) write(recording, name, change(series));
      continue;
    }
    const OrientationSeries turns = OrientationSeries::read(recording, joint.name);
    if (turns.empty()) continue;
    std::vector<double> values[4];
    for (int k = 0; k < 4; ++k) values[k] = change(turns.number[k]);
    for (std::size_t row = 0; row < values[0].size(); ++row) {
      double square = 0.0;
      for (const auto& value : values) square += value[row] * value[row];
      for (auto& value : values) value[row] /= std::sqrt(square);
    }
    const char* const numbers[] = {"/w", "/x", "/y", "/z"};
    for (int k = 0; k < 4; ++k) write(recording, joint.name + numbers[k], values[k]);
  }
  return recording;
}

}  // namespace

Dataset with_smooth_postures(const RobotModel& robot, const Dataset& recording,
                             const PostureNoiseOptions& options) {
  return changed(robot, recording, [&](const Series& series) { return smoothed(series, options); });
}

Dataset with_noisier_postures(const RobotModel& robot, const Dataset& recording,
                              std::uint64_t seed) {
  const CounterRandom random(seed, 91);
  std::uint64_t index = 0;
  return changed(robot, recording, [&](const Series& series) {
    std::vector<double> values = series.values;
    const Eigen::Map<const Eigen::VectorXd> all(values.data(),
                                                static_cast<Eigen::Index>(values.size()));
    const double sigma = white_noise(all.cast<float>());
    for (double& value : values) value += sigma * random.normal(index++);
    return values;
  });
}

}  // namespace discovery
}  // namespace anthrob
