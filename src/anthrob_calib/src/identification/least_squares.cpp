#include "identification/least_squares.h"

#include <ceres/ceres.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

namespace anthrob {
namespace identification {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The problem in parameters of the size of one.
class ScaledCost final : public ceres::CostFunction {
 public:
  explicit ScaledCost(const LeastSquares& problem) : problem_(problem) {
    set_num_residuals(static_cast<int>(problem.residual_count));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.parameters.size()));
  }

  bool Evaluate(double const* const* scaled, double* residuals,
                double** derivatives) const override {
    const std::size_t n = problem_.parameters.size();
    std::vector<double> values(n);
    for (std::size_t i = 0; i < n; ++i) values[i] = scaled[0][i] * problem_.parameters[i].scale;
    double* jacobian = derivatives ? derivatives[0] : nullptr;
    problem_.evaluate(values.data(), residuals, jacobian);
    if (!jacobian) return true;
    for (std::size_t row = 0; row < problem_.residual_count; ++row) {
      for (std::size_t i = 0; i < n; ++i) jacobian[row * n + i] *= problem_.parameters[i].scale;
    }
    return true;
  }

 private:
  const LeastSquares& problem_;
};

void minimise(const LeastSquares& problem, std::vector<double>& scaled) {
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ScaledCost cost(problem);
  ceres::Problem ceres_problem(ownership);
  ceres_problem.AddResidualBlock(&cost, nullptr, scaled.data());
  for (std::size_t i = 0; i < scaled.size(); ++i) {
    const LeastSquares::Parameter& p = problem.parameters[i];
    ceres_problem.SetParameterLowerBound(scaled.data(), static_cast<int>(i), p.lower / p.scale);
    ceres_problem.SetParameterUpperBound(scaled.data(), static_cast<int>(i), p.upper / p.scale);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-10;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem, &summary);
  if (summary.termination_type != ceres::CONVERGENCE) {
    throw std::runtime_error("the fit does not converge: " + summary.message);
  }
}

/// Index of the first parameter at one of its bounds, if any is.
std::optional<std::size_t> first_at_bound(const LeastSquares& problem,
                                          const std::vector<double>& scaled) {
  constexpr double kNear = 1e-9;  // of the bound
  for (std::size_t i = 0; i < scaled.size(); ++i) {
    const LeastSquares::Parameter& p = problem.parameters[i];
    for (const double bound : {p.lower / p.scale, p.upper / p.scale}) {
      if (std::isfinite(bound) && std::abs(scaled[i] - bound) <= kNear * std::abs(bound)) {
        return i;
      }
    }
  }
  return std::nullopt;
}

/// Sum of squares of the blocks' gradients, each as if the fit had not seen that block (the
/// jackknife, in its closed form for linear models). Without that, blocks that decide a parameter,
/// as the first second of a relaxation does, hide their own errors.
Eigen::MatrixXd scatter_of_blocks(const std::vector<int>& block, int pieces,
                                  const Eigen::VectorXd& residuals, const RowMajor& jacobian,
                                  const Eigen::MatrixXd& inverse) {
  const Eigen::Index n = jacobian.cols(), rows = jacobian.rows();
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index begin = 0, end = 0; begin < rows; begin = end) {
    while (end < rows &&
           block[static_cast<std::size_t>(end)] == block[static_cast<std::size_t>(begin)]) {
      ++end;
    }
    const auto own = jacobian.middleRows(begin, end - begin);
    const Eigen::VectorXd gradient = own.transpose() * residuals.segment(begin, end - begin);
    const Eigen::MatrixXd others =
        Eigen::MatrixXd::Identity(n, n) - own.transpose() * own * inverse;
    const Eigen::VectorXd unseen = others.fullPivLu().solve(gradient);
    scatter += unseen * unseen.transpose();
  }
  return (pieces - 1.0) / pieces * scatter;
}

/// Covariance of the scaled parameters.
Eigen::MatrixXd covariance_of(const LeastSquares& problem, const Eigen::VectorXd& residuals,
                              const RowMajor& jacobian, int pieces, int freedom) {
  const Eigen::MatrixXd information = jacobian.transpose() * jacobian;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(information);
  if (!(eigen.eigenvalues()[0] > 1e-12 * eigen.eigenvalues().maxCoeff())) {
    throw std::runtime_error("the data cannot distinguish the parameters of the fit");
  }
  const Eigen::MatrixXd inverse = eigen.eigenvectors() *
                                  eigen.eigenvalues().cwiseInverse().asDiagonal() *
                                  eigen.eigenvectors().transpose();
  if (problem.block.empty()) return residuals.squaredNorm() / freedom * inverse;
  return inverse * scatter_of_blocks(problem.block, pieces, residuals, jacobian, inverse) * inverse;
}

}  // namespace

Estimate Fit::estimate(std::size_t i) const {
  const auto k = static_cast<Eigen::Index>(i);
  return make_estimate(values[i], std::sqrt(covariance(k, k)), freedom);
}

Fit solve(const LeastSquares& problem) {
  const std::size_t n = problem.parameters.size(), rows = problem.residual_count;
  const int pieces = problem.block.empty() ? static_cast<int>(rows) : problem.block.back() + 1;
  Fit fit;
  fit.freedom = pieces - static_cast<int>(n);
  if (fit.freedom < 1) {
    throw std::runtime_error("too little data for a fit: " + std::to_string(pieces) +
                             " independent pieces for " + std::to_string(n) + " parameters");
  }
  std::vector<double> scaled;
  for (const auto& p : problem.parameters) scaled.push_back(p.start / p.scale);
  minimise(problem, scaled);

  Eigen::VectorXd residuals(rows);
  RowMajor jacobian(rows, n);
  const double* const at = scaled.data();
  double* derivatives = jacobian.data();
  ScaledCost(problem).Evaluate(&at, residuals.data(), &derivatives);
  fit.deviation = std::sqrt(residuals.squaredNorm() / static_cast<double>(rows));

  fit.at_bound = first_at_bound(problem, scaled);
  fit.covariance = covariance_of(problem, residuals, jacobian, pieces, fit.freedom);
  for (std::size_t i = 0; i < n; ++i) {
    const double scale = problem.parameters[i].scale;
    fit.values.push_back(scaled[i] * scale);
    fit.covariance.row(static_cast<Eigen::Index>(i)) *= scale;
    fit.covariance.col(static_cast<Eigen::Index>(i)) *= scale;
  }
  return fit;
}

}  // namespace identification
}  // namespace anthrob
