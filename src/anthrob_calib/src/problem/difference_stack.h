#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "optimiser/evaluator.h"
#include "problem/problem.h"

namespace anthrob {
namespace calibration {

/// The list of residuals that the fit minimises (Problem::residuals()), with what is known of the
/// noise in each of its rows. It is an Evaluator, so that derivatives() can use it.
///
/// An instant of a path has the noise of its kind; neighbouring instants may be correlated. The
/// postures at rest before and after a trajectory are means over time: their noise is smaller, as
/// far as it changes within that time. How far it does is seen in the path. A mean and the instants
/// of the path in the same time have noise in common.
class DifferenceStack final : public Evaluator {
 public:
  enum Kind { kPosture, kForce };

  /// One number of the list.
  struct Row {
    Kind kind = kPosture;
    double weight = 0.0;      ///< of the difference in the list; 0: it is not fitted
    int instant = 0;          ///< counted over all parts of all runs
    bool is_typical = true;   ///< the noise of its kind is estimated from such rows
    double deviation = 1.0;   ///< of its noise, in those of typical rows
    double repetition = 1.0;  ///< that many neighbouring rows are correlated and count as one
    /// Variance of its noise in the list, all of `repetition` together, in those of typical rows.
    double list_variance = 1.0;
    /// Of a mean: rows of the path, of the same joint or muscle, whose noise is correlated with its
    /// own, with their covariance in variances of typical rows.
    std::vector<std::pair<int, double>> related = {};
  };

  /// @param before_each called before each simulation of all runs; may throw to end the work
  DifferenceStack(const Problem& problem, std::function<void()> before_each)
      : problem_(problem), before_each_(std::move(before_each)) {}

  std::vector<double> fitness(const std::vector<Point>& points) override;
  std::vector<std::vector<double>> residuals(const std::vector<Point>& points) override;

  /// Returns the list at the best point and fills the descriptions of its rows below.
  /// @throws BadInput, NumericalFailure if the point is invalid
  std::vector<double> describe(const Point& best);

  std::vector<Row> rows;
  int instants = 0;
  /// Of typical rows, by kind: forces may be as slow as the relaxation of rings where postures have
  /// the noise of a camera.
  std::array<double, 2> repetition = {1.0, 1.0};

 private:
  class PathNoise;
  void describe_run(const MeasuredRun& run, const RunDifferences& differences,
                    const std::array<PathNoise, 2>& noise);

  const Problem& problem_;
  std::function<void()> before_each_;
};

/// Noise of postures and forces, estimated from the remaining differences: of instants of a path,
/// or of means where no path is fitted. Rows that the parameters could follow count less, because
/// the fit has made them small.
struct ResidualNoise {
  double posture = 0.0;         ///< [rad]
  double force = 0.0;           ///< [N]
  double free[2] = {0.0, 0.0};  ///< degrees of freedom of each kind
  /// By kind: the parameters could follow nearly all of the noise, so that it is hardly known. At
  /// least a tenth of the rows count as free then: the noise is taken as up to three times the
  /// differences that remain, and no more.
  bool absorbed[2] = {false, false};

  ResidualNoise() = default;
  /// @param left the list at the best point   @param leverage of each row
  ResidualNoise(const DifferenceStack& stack, const std::vector<double>& left,
                const Eigen::VectorXd& leverage);
  /// Of a typical row.
  double of(DifferenceStack::Kind kind) const {
    return kind == DifferenceStack::kPosture ? posture : force;
  }
  double of(const DifferenceStack::Row& row) const { return row.deviation * of(row.kind); }
};

}  // namespace calibration
}  // namespace anthrob
