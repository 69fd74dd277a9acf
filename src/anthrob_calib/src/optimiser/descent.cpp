#include "optimiser/descent.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "optimiser/least_squares_optimiser.h"

namespace anthrob {
namespace calibration {

namespace {

/// A smaller share of the fitness is not worth another Jacobian.
constexpr double kWorthwhile = 1e-4;
/// A step by secants that gains less is the last one before a new Jacobian.
constexpr double kWorthASecant = 0.01;
constexpr double kFirstRadius = 100.0;  ///< of trust

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Point unscaled(const std::vector<SearchVariable>& variables, const double* z) {
  Point point;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const SearchVariable& v = variables[i];
    point.push_back(std::min(std::max(v.initial + z[i] * v.step, v.lower), v.upper));
  }
  return point;
}

/// The Jacobian by steps at the point where it was last asked for.
class SecantJacobian {
 public:
  SecantJacobian(const std::vector<SearchVariable>& variables, double difference,
                 Evaluator& evaluator)
      : variables_(variables), difference_(difference), evaluator_(evaluator) {}

  /// By differences the first time, by the secant since the last time after that.
  const RowMajor& at(const Eigen::VectorXd& z, const Eigen::VectorXd& residuals) {
    if (jacobian_.size() == 0) {
      take(z, residuals);
    } else {
      const Eigen::VectorXd step = z - z_;
      const Eigen::VectorXd missed = residuals - residuals_ - jacobian_ * step;
      if (step.squaredNorm() > 0.0) jacobian_ += missed * step.transpose() / step.squaredNorm();
      ++age_;
    }
    z_ = z;
    residuals_ = residuals;
    return jacobian_;
  }

  const std::vector<double>& sensitivity() const { return sensitivity_; }
  int age() const { return age_; }  ///< secants since it was taken by differences
  /// It will be taken by differences again.
  void forget() {
    jacobian_.resize(0, 0);
    age_ = 0;
  }

 private:
  void take(const Eigen::VectorXd& z, const Eigen::VectorXd& residuals) {
    const std::vector<double> here(residuals.begin(), residuals.end());
    const auto columns =
        derivatives(variables_, unscaled(variables_, z.data()), here, difference_, evaluator_);
    jacobian_.resize(residuals.size(), z.size());
    sensitivity_.resize(columns.size(), 0.0);
    for (Eigen::Index i = 0; i < z.size(); ++i) {
      jacobian_.col(i) = Eigen::Map<const Eigen::VectorXd>(columns[i].data(), residuals.size());
      double& most = sensitivity_[static_cast<std::size_t>(i)];
      most = std::max(most, jacobian_.col(i).norm());
    }
  }

  const std::vector<SearchVariable>& variables_;
  double difference_;  ///< [steps]
  Evaluator& evaluator_;
  RowMajor jacobian_;
  Eigen::VectorXd z_, residuals_;
  std::vector<double> sensitivity_;  ///< Descent has it
  int age_ = 0;
};

/// Residuals as a function of the variables in steps from their start.
class Cost final : public ceres::CostFunction {
 public:
  /// @param residuals at z
  Cost(const std::vector<SearchVariable>& variables, const std::vector<double>& z,
       const std::vector<double>& residuals, Evaluator& evaluator, SecantJacobian& jacobian)
      : variables_(variables),
        evaluator_(evaluator),
        jacobian_(jacobian),
        z_(Eigen::Map<const Eigen::VectorXd>(z.data(), static_cast<Eigen::Index>(z.size()))),
        residuals_(Eigen::Map<const Eigen::VectorXd>(residuals.data(),
                                                     static_cast<Eigen::Index>(residuals.size()))) {
    set_num_residuals(static_cast<int>(residuals.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(variables.size()));
  }

  double fitness() const { return residuals_.squaredNorm(); }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const auto columns = static_cast<Eigen::Index>(variables_.size());
    const Eigen::Map<const Eigen::VectorXd> z(parameters[0], columns);
    // Ceres asks for the Jacobian at the point that it has just tried.
    if (z != z_) {
      const std::vector<double> r = evaluator_.residuals({unscaled(variables_, z.data())}).front();
      if (r.empty()) return false;  // an invalid point: Ceres goes back
      residuals_ = Eigen::Map<const Eigen::VectorXd>(r.data(), num_residuals());
      z_ = z;
    }
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = residuals_;
    if (!jacobians || !jacobians[0]) return true;
    Eigen::Map<RowMajor> jacobian(jacobians[0], num_residuals(), columns);
    jacobian = jacobian_.at(z_, residuals_);
    hold_at_bounds(jacobian);
    return true;
  }

 private:
  /// A variable at a bound that would go beyond stays. Else Ceres takes a step that counts on it,
  /// cuts it off at the bound, finds less than promised and trusts the next step less.
  void hold_at_bounds(Eigen::Map<RowMajor>& jacobian) const {
    const Eigen::VectorXd gradient = jacobian.transpose() * residuals_;
    for (Eigen::Index i = 0; i < z_.size(); ++i) {
      const SearchVariable& v = variables_[static_cast<std::size_t>(i)];
      const double value = v.initial + z_[i] * v.step, near = 1e-9 * v.step;
      const bool below = value <= v.lower + near && gradient[i] > 0.0;
      const bool above = value >= v.upper - near && gradient[i] < 0.0;
      if (below || above) jacobian.col(i).setZero();
    }
  }

  const std::vector<SearchVariable>& variables_;
  Evaluator& evaluator_;
  SecantJacobian& jacobian_;
  mutable Eigen::VectorXd z_, residuals_;  ///< last tried
};

/// Ends a solution where secants no longer help.
class EndOfSecants final : public ceres::IterationCallback {
 public:
  explicit EndOfSecants(const SecantJacobian& jacobian) : jacobian_(jacobian) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    // By now Ceres has asked for the Jacobian of the next step.
    const int age = age_;
    age_ = jacobian_.age();
    const bool helped = step.step_is_successful && step.cost_change > kWorthASecant * step.cost;
    return age == 0 || helped ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

 private:
  const SecantJacobian& jacobian_;
  int age_ = 0;
};

ceres::Solver::Options solver_options(double radius) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  // A step that changes nothing where much was promised is no end, only too long.
  options.function_tolerance = 1e-9;
  options.parameter_tolerance = 1e-4;
  options.max_num_iterations = 30;  // a new Jacobian is worth more then
  options.initial_trust_region_radius = radius;
  // Between bounds Ceres also searches along the step; the default would ask for a Jacobian at each
  // trial point.
  options.line_search_interpolation_type = ceres::QUADRATIC;
  options.logging_type = ceres::SILENT;
  return options;
}

/// As far as one Jacobian by differences and its secants lead. @param z [steps], where it begins
/// and ends
ceres::Solver::Summary solve(Cost& cost, const SecantJacobian& jacobian,
                             const std::vector<SearchVariable>& variables, double radius,
                             std::vector<double>& z) {
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&cost, nullptr, z.data());
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const SearchVariable& v = variables[i];
    problem.SetParameterLowerBound(z.data(), static_cast<int>(i), (v.lower - v.initial) / v.step);
    problem.SetParameterUpperBound(z.data(), static_cast<int>(i), (v.upper - v.initial) / v.step);
  }
  EndOfSecants end_of_secants(jacobian);
  ceres::Solver::Options options = solver_options(radius);
  options.callbacks.push_back(&end_of_secants);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary;
}

/// The last good step. What Ceres calls the final cost may be that of a step not taken, and a
/// secant that misled says nothing of how far a new Jacobian is good for.
const ceres::IterationSummary* last_good(const ceres::Solver::Summary& summary) {
  const ceres::IterationSummary* last = nullptr;
  for (const ceres::IterationSummary& step : summary.iterations) {
    if (step.step_is_successful) last = &step;
  }
  return summary.termination_type == ceres::FAILURE ? nullptr : last;
}

}  // namespace

Descent descend(const std::vector<SearchVariable>& variables, double difference, const Point& from,
                Evaluator& evaluator, int& jacobians) {
  const std::vector<double> start = evaluator.residuals({from}).front();
  if (start.empty()) return {from, HUGE_VAL, Descent::kInvalidStart};
  std::vector<double> z;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    z.push_back((from[i] - variables[i].initial) / variables[i].step);
  }
  SecantJacobian jacobian(variables, difference, evaluator);
  Cost cost(variables, z, start, evaluator, jacobian);
  Descent down{from, cost.fitness(), Descent::kMoreToGain};
  for (double radius = kFirstRadius; jacobians > 0 && down.end == Descent::kMoreToGain;
       --jacobians) {
    jacobian.forget();
    const ceres::Solver::Summary summary = solve(cost, jacobian, variables, radius, z);
    const ceres::IterationSummary* const last = last_good(summary);
    if (!last) {
      down.end = Descent::kStuck;
      break;
    }
    radius = last->trust_region_radius;
    if (2.0 * last->cost >= (1.0 - kWorthwhile) * down.fitness) down.end = Descent::kConverged;
    down.point = unscaled(variables, z.data());
    down.fitness = 2.0 * last->cost;
  }
  down.sensitivity = jacobian.sensitivity();
  return down;
}

}  // namespace calibration
}  // namespace anthrob
