#pragma once

#include <Eigen/Core>
#include <functional>
#include <utility>
#include <vector>

#include "anthrob_calib/calibration/problem.h"
#include "anthrob_calib/optimiser/evaluator.h"

namespace anthrob {
namespace calibration {

/// The differences of all runs (RunDifferences::shown()) in one list, weighted as in the fitness.
/// It is an Evaluator, so that derivatives() can use it.
class DifferenceStack final : public Evaluator {
 public:
  enum Kind { kPosture, kForce };

  /// @param before_each called before each simulation of all runs; may throw to end the work
  DifferenceStack(const Problem& problem, std::function<void()> before_each)
      : problem_(problem), before_each_(std::move(before_each)) {}

  std::vector<double> fitness(const std::vector<Point>& points) override;
  std::vector<std::vector<double>> residuals(const std::vector<Point>& points) override;

  /// Returns the list at the best point and fills the descriptions of its rows below.
  /// @throws BadInput, NumericalFailure if the point is invalid
  std::vector<double> describe(const Point& best);

  std::vector<Kind> kind;      ///< of each row
  std::vector<double> weight;  ///< of each row
  std::vector<int> instant;    ///< of each row, counted over all runs
  int instants = 0;
  /// Neighbouring instants of a trajectory are correlated: this many of them count as one.
  double repetition = 1.0;

 private:
  void describe_instants(const Eigen::MatrixXd& differences);
  std::vector<RunDifferences> simulate(const Point& point) const;
  double posture_weight(const Differences& d) const;
  double force_weight(const Differences& d) const;
  void append(const Differences& d, std::vector<double>& list) const;
  std::vector<double> list(const Point& point) const;

  const Problem& problem_;
  std::function<void()> before_each_;
};

/// Noise of postures and forces, estimated from the remaining differences. Rows that the parameters
/// could follow count less, because the fit has made them small.
struct ResidualNoise {
  double posture = 0.0;         ///< [rad]
  double force = 0.0;           ///< [N]
  double free[2] = {0.0, 0.0};  ///< degrees of freedom of each kind

  /// @param left the list at the best point   @param leverage of each row
  ResidualNoise(const DifferenceStack& stack, const std::vector<double>& left,
                const Eigen::VectorXd& leverage);
  double of(DifferenceStack::Kind kind) const {
    return kind == DifferenceStack::kPosture ? posture : force;
  }
};

}  // namespace calibration
}  // namespace anthrob
