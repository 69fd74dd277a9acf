#include "anthrob_calib/calibration/identifiability.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "anthrob_calib/optimiser/least_squares_optimiser.h"
#include "anthrob_calib/optimiser/problem_evaluator.h"

namespace anthrob {
namespace calibration {

namespace {

/// All shown differences of all runs in one list, postures and forces each divided by their noise.
/// As an evaluator, so that derivatives() can be taken.
class Stack final : public Evaluator {
 public:
  explicit Stack(const Problem& problem) : problem_(problem) {}

  std::vector<double> fitness(const std::vector<Point>&) override { return {}; }

  std::vector<std::vector<double>> residuals(const std::vector<Point>& points) override {
    std::vector<std::vector<double>> lists;
    for (const Point& point : points) lists.push_back(list(point));
    return lists;
  }

  /// Noise from what is left at the best point. Instants of a trajectory are no independent
  /// witnesses: noise grows by how alike neighbours are.
  void learn_noise(const Point& best) {
    const auto runs = simulate(best);
    double posture = 0.0, force = 0.0, like = 0.0, all = 0.0;
    Eigen::Index posture_count = 0, force_count = 0;
    for (const RunDifferences& run : runs) {
      const Differences& d = run.shown();
      posture += d.posture.squaredNorm(), posture_count += d.posture.size();
      force += d.force.squaredNorm(), force_count += d.force.size();
      const Eigen::Index rows = d.posture.rows();
      if (rows < 2) continue;
      like += d.posture.topRows(rows - 1).cwiseProduct(d.posture.bottomRows(rows - 1)).sum();
      all += d.posture.topRows(rows - 1).squaredNorm();
    }
    const double alike = all > 0.0 ? std::clamp(like / all, 0.0, 0.999) : 0.0;
    inflation_ = std::sqrt((1.0 + alike) / (1.0 - alike));
    const auto count = static_cast<double>(posture_count + force_count);
    const double free = count / std::max(1.0, count - static_cast<double>(best.size()));
    constexpr double kSmallest = 1e-9;  // perfect data
    posture_noise = std::max(kSmallest, std::sqrt(free * posture / posture_count));
    force_noise = std::max(kSmallest, std::sqrt(free * force / force_count));
  }

  double posture_noise = 1.0, force_noise = 1.0;

 private:
  std::vector<RunDifferences> simulate(const Point& point) const {
    return simulate_runs(problem_.build(point), problem_.runs(), problem_.options());
  }

  std::vector<double> list(const Point& point) const {
    std::vector<double> list;
    try {
      for (const RunDifferences& run : simulate(point)) {
        const Differences& d = run.shown();
        for (const double x : d.posture.reshaped())
          list.push_back(x / (posture_noise * inflation_));
        for (const double x : d.force.reshaped()) list.push_back(x / (force_noise * inflation_));
      }
    } catch (const BadInput&) {
      list.clear();
    } catch (const NumericalFailure&) {
      list.clear();
    }
    return list;
  }

  const Problem& problem_;
  double inflation_ = 1.0;
};

Profile draw_profile(const Problem& problem, const std::vector<SearchVariable>& variables,
                     const Point& best, const Eigen::MatrixXd& information, std::size_t index,
                     double sigma) {
  const auto n = static_cast<Eigen::Index>(best.size());
  const auto i = static_cast<Eigen::Index>(index);
  // Others follow a change of one by minus (A_oo)^-1 A_oi.
  Eigen::MatrixXd others = information;
  others.row(i).setZero();
  others.col(i).setZero();
  others(i, i) = 1.0;
  Eigen::VectorXd coupling = information.col(i);
  coupling(i) = 0.0;
  const Eigen::VectorXd response = -others.ldlt().solve(coupling);

  Profile profile;
  profile.parameter = index;
  for (const double share : {-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5}) {
    const double change = share * sigma / variables[index].step;  // [steps]
    Point point = best;
    for (Eigen::Index k = 0; k < n; ++k) {
      const SearchVariable& v = variables[k];
      const double steps = k == i ? change : change * response(k);
      point[k] = std::clamp(best[k] + steps * v.step, v.lower, v.upper);
    }
    if (!profile.value.empty() && point[index] == profile.value.back()) continue;  // at a bound
    profile.value.push_back(point[index]);
    profile.fitness.push_back(problem.fitness(point));
  }
  return profile;
}

}  // namespace

Identifiability examine(const Problem& problem, const std::vector<double>& best, int profiles) {
  Identifiability result;
  const std::vector<SearchVariable> variables = search_variables(problem.space());
  Stack stack(problem);
  stack.learn_noise(best);
  result.posture_noise = stack.posture_noise;
  result.force_noise = stack.force_noise;

  const std::vector<double> base = stack.residuals({best}).front();
  const auto columns =
      derivatives(variables, best, base, LeastSquaresOptimiser::kDifference, stack);
  const auto n = static_cast<Eigen::Index>(best.size());
  Eigen::MatrixXd jacobian(static_cast<Eigen::Index>(base.size()), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    jacobian.col(i) = Eigen::Map<const Eigen::VectorXd>(columns[i].data(), jacobian.rows());
  }
  Eigen::MatrixXd information = jacobian.transpose() * jacobian;  // by steps
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(information);
  result.singular_values = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().reverse();
  const Eigen::VectorXd flattest = eigen.eigenvectors().col(0);
  result.flattest.assign(flattest.data(), flattest.data() + n);

  // The range of a parameter is knowledge too; without it some would have no error at all.
  for (Eigen::Index i = 0; i < n; ++i) {
    const double prior = (variables[i].upper - variables[i].lower) / std::sqrt(12.0);
    result.parameters.push_back({0.0, prior, false});
    information(i, i) += std::pow(variables[i].step / prior, 2);
  }
  const Eigen::MatrixXd covariance = information.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
  for (Eigen::Index i = 0; i < n; ++i) {
    ParameterKnowledge& p = result.parameters[i];
    p.sigma = std::sqrt(std::max(0.0, covariance(i, i))) * variables[i].step;
    p.identifiable = p.sigma < kIdentifiableShare * p.prior_sigma;
  }

  std::vector<std::size_t> order(best.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto doubt = [&](std::size_t i) {
    return result.parameters[i].sigma / result.parameters[i].prior_sigma;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return doubt(a) > doubt(b); });
  for (const std::size_t i : order) {
    if (static_cast<int>(result.profiles.size()) >= profiles) break;
    if (result.parameters[i].identifiable) break;
    result.profiles.push_back(
        draw_profile(problem, variables, best, information, i, result.parameters[i].sigma));
  }
  return result;
}

int equilibria_needed(int unknowns, int muscles) {
  return std::max(1, (unknowns - muscles + 2) / 3);
}

}  // namespace calibration
}  // namespace anthrob
