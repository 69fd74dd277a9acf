#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

namespace anthrob {
namespace health {

/// A number with its standard error.
struct Measured {
  double value = 0.0, sigma = 0.0;
  double half = 0.0;  ///< of the 95 % interval, by Student's t of the number of blocks
};

/// Linear least squares, whose errors are those of the jackknife over blocks of time: neighbouring
/// rows are no independent witnesses.
class BlockFit {
 public:
  /// @param terms of a row   @param blocks of time
  BlockFit(int terms, int blocks);

  void add(int block, const Eigen::VectorXd& terms, double value);
  /// A number that follows from the coefficients.
  /// @return nothing if fewer than three blocks have rows, or the terms do not tell it
  std::optional<Measured> number(const std::function<double(const Eigen::VectorXd&)>& of) const;
  std::optional<Measured> coefficient(int term) const;

 private:
  struct Sums {
    Eigen::MatrixXd gram;
    Eigen::VectorXd right;
    double rows = 0.0;
  };
  std::optional<Eigen::VectorXd> solved(int without) const;

  std::vector<Sums> blocks_;
};

}  // namespace health
}  // namespace anthrob
