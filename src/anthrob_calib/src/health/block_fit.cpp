#include "health/block_fit.h"

#include <Eigen/Cholesky>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace anthrob {
namespace health {

BlockFit::BlockFit(int terms, int blocks)
    : blocks_(static_cast<std::size_t>(blocks),
              {Eigen::MatrixXd::Zero(terms, terms), Eigen::VectorXd::Zero(terms), 0.0}) {}

void BlockFit::add(int block, const Eigen::VectorXd& terms, double value) {
  Sums& sums = blocks_[static_cast<std::size_t>(block)];
  sums.gram += terms * terms.transpose();
  sums.right += value * terms;
  sums.rows += 1.0;
}

std::optional<Eigen::VectorXd> BlockFit::solved(int without) const {
  Sums all{0.0 * blocks_[0].gram, 0.0 * blocks_[0].right, 0.0};
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (static_cast<int>(b) == without) continue;
    all.gram += blocks_[b].gram, all.right += blocks_[b].right;
  }
  Eigen::VectorXd scale = all.gram.diagonal();
  if (!(scale.minCoeff() > 0.0)) return {};
  scale = scale.cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(scale.asDiagonal() * all.gram * scale.asDiagonal());
  if (ldlt.info() != Eigen::Success || ldlt.vectorD().minCoeff() < 1e-9) return {};
  return Eigen::VectorXd(scale.asDiagonal() * ldlt.solve(scale.asDiagonal() * all.right));
}

std::optional<Measured> BlockFit::number(
    const std::function<double(const Eigen::VectorXd&)>& of) const {
  const auto all = solved(-1);
  if (!all) return {};
  Measured measured{of(*all)};
  double squares = 0.0, count = 0.0;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (!(blocks_[b].rows > 0.0)) continue;
    const auto rest = solved(static_cast<int>(b));
    if (!rest) return {};
    squares += std::pow(of(*rest) - measured.value, 2), count += 1.0;
  }
  if (count < 3.0 || !std::isfinite(measured.value) || !std::isfinite(squares)) return {};
  measured.sigma = std::sqrt(squares * (count - 1.0) / count);
  const boost::math::students_t student(count - 1.0);
  measured.half = boost::math::quantile(student, 0.975) * measured.sigma;
  return measured;
}

std::optional<Measured> BlockFit::coefficient(int term) const {
  return number([term](const Eigen::VectorXd& x) { return x[term]; });
}

}  // namespace health
}  // namespace anthrob
