#include "measurement/clock_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "anthrob_recording/series.h"

namespace anthrob {
namespace discovery {

namespace {

/// Normal equations of one column: what is missing is constant - late rate - drift (t - middle)
/// rate.
struct ClockSums {
  Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();
  Eigen::Vector3d cross = Eigen::Vector3d::Zero();

  void add(const Eigen::Vector3d& terms, double value, double weight) {
    gram += weight * terms * terms.transpose();
    cross += weight * terms * value;
  }
  /// Without its constant.
  ClockSums centred() const {
    ClockSums out = *this;
    if (!(gram(0, 0) > 0.0)) return out;
    out.gram -= gram.col(0) * gram.row(0) / gram(0, 0);
    out.cross -= gram.col(0) * cross[0] / gram(0, 0);
    return out;
  }
};

struct ColumnSums {
  std::vector<ClockSums> blocks;

  ClockSums without(std::size_t left_out) const {
    ClockSums all;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      if (b == left_out) continue;
      all.gram += blocks[b].gram, all.cross += blocks[b].cross;
    }
    return all.centred();
  }
};

/// A column without its gaps.
Series series_of(const Table& table, const Column& column) {
  Series series;
  for (std::size_t i = 0; i < table.t.size(); ++i) {
    if (!column.present[i] || !std::isfinite(column.values[i])) continue;
    series.t.push_back(seconds(table.t[i]));
    series.values.push_back(column.values[i]);
  }
  return series;
}

/// @param late by how much the measured stamps are known to be late [s]: what is left is fitted
/// @param middle of the table [s]
ColumnSums sums_of(const Series& measured, const Series& simulated, double late, double middle,
                   std::size_t blocks, const ClockFitOptions& options) {
  ColumnSums sums;
  sums.blocks.resize(blocks);
  double n = 0.0, sum = 0.0, squares = 0.0;
  const auto visit = [&](const auto& use) {
    for (std::size_t i = 0; i < measured.t.size(); ++i) {
      const double then = measured.t[i] - late;
      if (then - options.beside < simulated.t.front()) continue;
      if (then + options.beside > simulated.t.back()) break;
      use(measured.t[i], then, measured.values[i] - simulated.at(then));
    }
  };
  visit([&](double, double, double difference) {
    n += 1.0, sum += difference, squares += difference * difference;
  });
  const double spread = squares - sum * sum / std::max(1.0, n);
  if (!(spread > 0.0)) return sums;
  visit([&](double t, double then, double difference) {
    const double rate =
        (simulated.at(then + options.beside) - simulated.at(then - options.beside)) /
        (2.0 * options.beside);
    const auto block = static_cast<std::size_t>(std::max(0.0, t) / options.block);
    sums.blocks[std::min(block, blocks - 1)].add({1.0, -rate, -(t - middle) * rate}, difference,
                                                 n / spread);
  });
  return sums;
}

struct ColumnPair {
  Series measured, simulated;
};

/// The rest of lateness and drift, beyond `late`.
std::optional<ClockFit> fit_rest(const std::vector<ColumnPair>& pairs, double late, double middle,
                                 std::size_t blocks, const ClockFitOptions& options) {
  std::vector<ColumnSums> columns;
  for (const ColumnPair& pair : pairs) {
    columns.push_back(sums_of(pair.measured, pair.simulated, late, middle, blocks, options));
  }
  const auto solve = [&](std::size_t left_out) -> std::optional<Eigen::Vector2d> {
    Eigen::Matrix2d gram = Eigen::Matrix2d::Zero();
    Eigen::Vector2d cross = Eigen::Vector2d::Zero();
    for (const ColumnSums& column : columns) {
      const ClockSums own = column.without(left_out);
      gram += own.gram.bottomRightCorner<2, 2>();
      cross += own.cross.tail<2>();
    }
    const Eigen::LDLT<Eigen::Matrix2d> factors(gram);
    if (factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > 0.0)) return {};
    return factors.solve(cross);
  };
  const auto all = solve(blocks);
  if (!all) return {};
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  for (std::size_t b = 0; b < blocks; ++b) {
    const auto part = solve(b);
    if (!part) return {};
    squares += (*part - *all).cwiseAbs2();
  }
  const double scale = 1.0 - 1.0 / static_cast<double>(blocks);
  return ClockFit{(*all)[0], std::sqrt(scale * squares[0]), (*all)[1],
                  std::sqrt(scale * squares[1])};
}

}  // namespace

std::optional<ClockFit> fit_clock(const Table& measured, const Table& simulated,
                                  const ClockFitOptions& options) {
  if (measured.t.empty()) return {};
  const auto blocks =
      static_cast<std::size_t>(std::max(0.0, seconds(measured.t.back())) / options.block);
  if (blocks < options.fewest_blocks) return {};
  std::vector<ColumnPair> pairs;
  for (const Column& column : measured.columns) {
    const Column* other = simulated.find(column.name);
    if (!other) continue;
    ColumnPair pair{series_of(measured, column), series_of(simulated, *other)};
    if (!pair.measured.empty() && !pair.simulated.empty()) pairs.push_back(std::move(pair));
  }
  const double middle = 0.5 * (seconds(measured.t.front()) + seconds(measured.t.back()));
  double late = 0.0;
  for (int i = 0; i < options.steps; ++i) {
    const auto rest = fit_rest(pairs, late, middle, blocks, options);
    if (!rest) return {};
    late += rest->late;
  }
  auto fit = fit_rest(pairs, late, middle, blocks, options);
  if (!fit) return {};
  fit->late += late;
  return fit;
}

}  // namespace discovery
}  // namespace anthrob
