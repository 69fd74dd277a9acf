#include "measurement/lag_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>

#include "measurement/low_pass.h"

namespace anthrob {
namespace discovery {

namespace {

/// Normal equations of measured = constant + factor (expected - late rate), with their squares.
struct LagSums {
  Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();
  Eigen::Vector3d cross = Eigen::Vector3d::Zero();
  double squares = 0.0;

  void add(const Eigen::Vector3d& terms, double value) {
    gram += terms * terms.transpose();
    cross += terms * value;
    squares += value * value;
  }
  LagSums without(const LagSums& o) const {
    LagSums out;
    out.gram = gram - o.gram, out.cross = cross - o.cross, out.squares = squares - o.squares;
    return out;
  }
  double count() const { return gram(0, 0); }
  /// What constant and factor leave, over what a constant alone leaves.
  double left() const {
    const Eigen::Vector2d best = gram.topLeftCorner<2, 2>().ldlt().solve(cross.head<2>());
    const double variance = squares - cross[0] * cross[0] / count();
    return variance > 0.0 ? (squares - best.dot(cross.head<2>())) / variance : 1.0;
  }
};

/// Of one pair.
struct PairSums {
  LagSums all;
  std::vector<LagSums> blocks;
};

PairSums sums_at(const LaggingPair& pair, double late, const ClockFitOptions& options) {
  PairSums sums;
  const Series& expected = pair.expected;
  const double beside = options.beside;
  for (std::size_t i = 0; i < pair.measured.t.size(); ++i) {
    const double t = pair.measured.t[i], then = t - late;
    if (then - beside < expected.t.front() || then + beside > expected.t.back()) continue;
    if (!std::isfinite(pair.measured.values[i])) continue;
    const double rate = (expected.at(then + beside) - expected.at(then - beside)) / (2.0 * beside);
    const auto block = static_cast<std::size_t>(std::max(0.0, t) / options.block);
    if (sums.blocks.size() <= block) sums.blocks.resize(block + 1);
    const Eigen::Vector3d terms(1.0, expected.at(then), -rate);
    sums.blocks[block].add(terms, pair.measured.values[i]);
    sums.all.add(terms, pair.measured.values[i]);
  }
  return sums;
}

std::vector<PairSums> all_at(const std::vector<LaggingPair>& pairs, double late,
                             const ClockFitOptions& options) {
  std::vector<PairSums> sums;
  for (const LaggingPair& pair : pairs) sums.push_back(sums_at(pair, late, options));
  return sums;
}

/// Information about the lag, and the lag times it; zero where a pair tells none.
struct Vote {
  double weight = 0.0, sum = 0.0;
};

Vote vote_of(const LagSums& sums) {
  const Eigen::LDLT<Eigen::Matrix3d> factors(sums.gram);
  if (factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > 0.0)) return {};
  const Eigen::Vector3d best = factors.solve(sums.cross);
  const double variance = factors.solve(Eigen::Vector3d::UnitZ())[2];
  const double noise = sums.squares - best.dot(sums.cross), factor = best[1];
  if (!(variance > 0.0) || !(noise > 0.0) || factor == 0.0) return {};
  const double weight = factor * factor * sums.count() / (variance * noise);
  return {weight, weight * best[2] / factor};
}

/// How much later still.
double vote(const std::vector<PairSums>& pairs, std::optional<std::size_t> left_out) {
  Vote all;
  for (const PairSums& pair : pairs) {
    const bool has = left_out && *left_out < pair.blocks.size();
    const Vote own = vote_of(has ? pair.all.without(pair.blocks[*left_out]) : pair.all);
    all.weight += own.weight, all.sum += own.sum;
  }
  return all.weight > 0.0 ? all.sum / all.weight : 0.0;
}

double left_of(const std::vector<PairSums>& pairs) {
  double sum = 0.0;
  for (const PairSums& pair : pairs) sum += pair.all.left();
  return sum;
}

/// Of a grid of steps, where `squares` is least.
double best_of_grid(double from, double to, double step,
                    const std::function<double(double)>& squares) {
  double best = from, least = 1e300;
  const auto steps = static_cast<int>(std::ceil((to - from) / step));
  for (int k = 0; k <= steps; ++k) {
    const double at = from + (to - from) * k / steps, own = squares(at);
    if (own < least) least = own, best = at;
  }
  return best;
}

}  // namespace

std::optional<LagFit> fit_lag(const std::vector<LaggingPair>& pairs, double longest,
                              const ClockFitOptions& options) {
  if (pairs.empty()) return {};
  double late = best_of_grid(-longest, longest, options.beside,
                             [&](double at) { return left_of(all_at(pairs, at, options)); });
  for (int i = 0; i < options.steps; ++i) late += vote(all_at(pairs, late, options), {});
  if (!(std::abs(late) <= longest)) return {};
  const auto sums = all_at(pairs, late, options);
  std::size_t blocks = 0;
  for (const PairSums& pair : sums) blocks = std::max(blocks, pair.blocks.size());
  if (blocks < options.fewest_blocks) return {};
  const double whole = vote(sums, {});
  double squares = 0.0;
  for (std::size_t b = 0; b < blocks; ++b) squares += std::pow(vote(sums, b) - whole, 2);
  return LagFit{late, std::sqrt(squares * (1.0 - 1.0 / static_cast<double>(blocks))),
                left_of(sums)};
}

std::optional<LagFit> fit_filter(const std::vector<LaggingPair>& pairs, double longest,
                                 const ClockFitOptions& options) {
  if (pairs.empty()) return {};
  const auto squares = [&](double time_constant) {
    std::vector<LaggingPair> filtered = pairs;
    for (LaggingPair& pair : filtered) {
      const LowPass filter(pair.expected, time_constant, BetweenRows::kLinear);
      for (std::size_t i = 0; i < pair.expected.t.size(); ++i) {
        pair.expected.values[i] = filter.at(pair.expected.t[i]);
      }
    }
    return left_of(all_at(filtered, 0.0, options));
  };
  const double coarse = best_of_grid(options.beside / 5.0, longest, options.beside, squares);
  const double fine =
      best_of_grid(std::max(options.beside / 5.0, coarse - options.beside),
                   std::min(longest, coarse + options.beside), options.beside / 10.0, squares);
  return LagFit{fine, options.beside / 10.0, squares(fine)};
}

}  // namespace discovery
}  // namespace anthrob
