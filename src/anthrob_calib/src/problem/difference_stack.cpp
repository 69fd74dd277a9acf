#include "problem/difference_stack.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace calibration {

/// How the errors of one kind follow one another along the paths of all runs.
class DifferenceStack::PathNoise {
 public:
  /// @param errors one row per instant   @param block instants in the time of a mean
  void add(const Eigen::MatrixXd& errors, Eigen::Index block) {
    const Eigen::Index rows = errors.rows();
    squares_ += errors.squaredNorm();
    count_ += static_cast<double>(errors.size());
    if (rows < 2) return;
    like_ += errors.topRows(rows - 1).cwiseProduct(errors.bottomRows(rows - 1)).sum();
    compared_ += errors.topRows(rows - 1).squaredNorm();
    if (block < 2) return;
    block_ = static_cast<double>(block);
    Eigen::RowVectorXd last;
    for (Eigen::Index begin = 0; begin + block <= rows; begin += block) {
      const Eigen::RowVectorXd mean = errors.middleRows(begin, block).colwise().mean();
      block_squares_ += mean.squaredNorm();
      block_count_ += static_cast<double>(mean.size());
      if (begin > 0) {
        block_products_ += last.dot(mean);
        pair_count_ += static_cast<double>(mean.size());
      }
      last = mean;
    }
  }

  /// Number of neighbours that count as one. Two estimates: from the correlation of an instant with
  /// the next one, which is right for one kind of error, and from that of a block with the next
  /// one, where fast errors hide how long slow ones last.
  double repetition() const {
    const double alike = compared_ > 0.0 ? std::clamp(like_ / compared_, 0.0, kMost) : 0.0;
    const double together = (1.0 + alike) / (1.0 - alike);
    // Below that, what seems to last is the scatter of its estimate.
    constexpr double kLeastLasting = 0.05;
    if (!(pair_count_ > 0.0) || lasting() <= kLeastLasting) return together;
    const double neighbours = block_products_ / pair_count_ / (squares_ / count_);
    const double slow = std::pow(std::clamp(neighbours / lasting(), 0.0, 1.0), 1.0 / block_);
    const double alike_slow = std::min(slow, kMost);
    return std::max(together,
                    1.0 - lasting() + lasting() * (1.0 + alike_slow) / (1.0 - alike_slow));
  }

  /// Share of the variance of an instant that a mean keeps, however many measurements it is of.
  /// Errors consist of a part that is new in each measurement and of one that stays for the time of
  /// a block. The squares of instants and of the means of blocks tell the two apart.
  double lasting() const {
    if (!(block_count_ > 0.0 && squares_ > 0.0)) return 1.0;
    const double of_instant = squares_ / count_, of_block = block_squares_ / block_count_;
    return 1.0 - std::clamp((1.0 - of_block / of_instant) * block_ / (block_ - 1.0), 0.0, 1.0);
  }

  /// Variance of a mean over the time of a block, in variances of an instant.
  /// @param measurements may be more than instants: sensors may be faster than paths are sampled
  double variance_of_mean(double measurements) const {
    return lasting() + (1.0 - lasting()) / measurements;
  }

  /// Covariance of such a mean with each instant of a path, in variances of an instant: up to the
  /// last one where it is worth mentioning.
  std::vector<std::pair<int, double>> covariances(const Samples& mean, double measurements,
                                                  const std::vector<double>& instants,
                                                  double period) const {
    constexpr double kLeast = 0.01;
    const double alike =
        (repetition() - 1.0) / (repetition() + 1.0);  // an instant and the next one
    std::vector<std::pair<int, double>> list;
    for (std::size_t i = 0; i < instants.size(); ++i) {
      const double apart =
          (std::abs(instants[i] - mean.t.front()) - 0.5 * mean.window) / period;  // [instants]
      // Within its time: on average, with what a mean is of, it varies as much as it does itself.
      const double covariance =
          apart < 1e-3 ? variance_of_mean(measurements) : lasting() * std::pow(alike, apart);
      if (covariance > kLeast) list.emplace_back(static_cast<int>(i), covariance);
    }
    return list;
  }

 private:
  static constexpr double kMost =
      0.999;  ///< correlation of neighbours, so that some number is left

  double squares_ = 0.0, count_ = 0.0;
  double like_ = 0.0, compared_ = 0.0;
  double block_ = 0.0, block_squares_ = 0.0, block_count_ = 0.0;
  double block_products_ = 0.0, pair_count_ = 0.0;  ///< of neighbouring blocks
};

namespace {

using Kind = DifferenceStack::Kind;

/// Share of the rows that count as not followed by the parameters, at least.
constexpr double kLeastFree = 0.1;

const Eigen::MatrixXd& errors_of(const Differences& differences, Kind kind) {
  return kind == DifferenceStack::kPosture ? differences.posture : differences.force;
}

double factor_of(const RunPart& part, Kind kind, const Weights& weights, double scale) {
  return kind == DifferenceStack::kPosture ? part.posture_factor(weights, scale)
                                           : part.force_factor(weights, scale);
}

}  // namespace

std::vector<double> DifferenceStack::fitness(const std::vector<Point>& points) {
  std::vector<double> fitness;
  for (const Point& point : points) {
    before_each_();
    fitness.push_back(problem_.fitness(point));
  }
  return fitness;
}

std::vector<std::vector<double>> DifferenceStack::residuals(const std::vector<Point>& points) {
  std::vector<std::vector<double>> lists;
  for (const Point& point : points) {
    before_each_();
    lists.push_back(problem_.residuals(point));
  }
  return lists;
}

std::vector<double> DifferenceStack::describe(const Point& best) {
  before_each_();
  const std::vector<MeasuredRun>& runs = problem_.runs();
  const auto all = simulate_runs(problem_.build(best), runs, problem_.options());
  std::array<PathNoise, 2> noise;
  if (problem_.weights().path > 0.0) {
    for (std::size_t r = 0; r < runs.size(); ++r) {
      if (all[r].path.count() < 2) continue;
      const double period = runs[r].path.t[1] - runs[r].path.t[0];
      const auto block = static_cast<Eigen::Index>(std::lround(runs[r].after.window / period));
      for (const Kind kind : {kPosture, kForce}) {
        noise[kind].add(errors_of(all[r].path, kind), block);
      }
    }
  }
  for (const Kind kind : {kPosture, kForce}) repetition[kind] = noise[kind].repetition();
  std::vector<double> list;
  const double share = 1.0 / static_cast<double>(runs.size());
  for (std::size_t r = 0; r < runs.size(); ++r) {
    all[r].append_residuals(problem_.weights(), share, list);
    describe_run(runs[r], all[r], noise);
  }
  return list;
}

void DifferenceStack::describe_run(const MeasuredRun& run, const RunDifferences& differences,
                                   const std::array<PathNoise, 2>& noise) {
  const Weights& weights = problem_.weights();
  const double scale = 1.0 / static_cast<double>(problem_.runs().size());
  const std::vector<RunPart> parts = differences.parts(weights);
  const Differences &before = differences.before, &path = differences.path;
  const bool fits_path = path.count() > 0 && weights.path > 0.0;
  const auto path_begin = static_cast<Eigen::Index>(rows.size()) + before.posture.size() +
                          before.force.size();  // in the list
  const std::vector<double> instants_of_path(run.path.t.begin(),
                                             run.path.t.begin() + path.count());  // simulated ones
  const double period = path.count() > 1 ? run.path.t[1] - run.path.t[0] : 1.0;   // [s]
  for (const RunPart& part : parts) {
    const bool is_path = &part.differences == &path;
    const Samples& measured = is_path                        ? run.path
                              : &part.differences == &before ? run.before
                                                             : run.after;
    for (const Kind kind : {kPosture, kForce}) {
      const Eigen::MatrixXd& errors = errors_of(part.differences, kind);
      Row row;
      row.kind = kind;
      row.weight = factor_of(part, kind, weights, scale);
      row.is_typical = row.weight > 0.0 && (is_path || !fits_path);
      std::vector<std::pair<int, double>> related;  // by instants of the path
      if (is_path) {
        row.repetition = row.list_variance = repetition[kind];
      } else if (fits_path && errors.size() > 0) {
        const double measurements =
            kind == kPosture ? measured.posture_measurements : measured.force_measurements;
        const double variance = noise[kind].variance_of_mean(measurements);
        related = noise[kind].covariances(measured, measurements, instants_of_path, period);
        const double of_path = factor_of(parts[1], kind, weights, scale);
        row.deviation = std::sqrt(variance);
        if (of_path > 0.0) row.list_variance = variance * std::pow(row.weight / of_path, 2);
      }
      const Eigen::Index kind_begin = path_begin + (kind == kForce ? path.posture.size() : 0);
      for (Eigen::Index i = 0; i < errors.rows(); ++i) {
        for (Eigen::Index column = 0; column < errors.cols(); ++column) {
          row.instant = instants + static_cast<int>(i);
          row.related.clear();
          for (const auto& [k, covariance] : related) {
            row.related.emplace_back(static_cast<int>(kind_begin + k * errors.cols() + column),
                                     covariance);
          }
          rows.push_back(row);
        }
      }
    }
    instants += part.differences.count();
  }
}

ResidualNoise::ResidualNoise(const DifferenceStack& stack, const std::vector<double>& left,
                             const Eigen::VectorXd& leverage) {
  constexpr int kPosture = DifferenceStack::kPosture, kForce = DifferenceStack::kForce;
  double square[2] = {0.0, 0.0}, count[2] = {0.0, 0.0};
  for (std::size_t k = 0; k < left.size(); ++k) {
    const DifferenceStack::Row& row = stack.rows[k];
    if (!row.is_typical) continue;
    square[row.kind] += std::pow(left[k] / row.weight, 2);
    count[row.kind] += 1.0;
    // Where rows repeat each other a parameter follows as many of them.
    free[row.kind] += 1.0 - row.repetition * leverage(static_cast<Eigen::Index>(k));
  }
  for (const int kind : {kPosture, kForce}) {
    const double least = kLeastFree * count[kind];
    absorbed[kind] = count[kind] > 0.0 && free[kind] < least;
    free[kind] = std::max(free[kind], least);
  }
  constexpr double kSmallest = 1e-9;  // perfect data
  posture = std::max(kSmallest, std::sqrt(square[kPosture] / std::max(1.0, free[kPosture])));
  force = std::max(kSmallest, std::sqrt(square[kForce] / std::max(1.0, free[kForce])));
}

}  // namespace calibration
}  // namespace anthrob
