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

enum Kind { kPosture, kForce };

/// All shown differences of all runs in one list, weighted as the fitness weights them. As an
/// evaluator, so that derivatives() can be taken.
class Stack final : public Evaluator {
 public:
  explicit Stack(const Problem& problem) : problem_(problem) {}

  std::vector<double> fitness(const std::vector<Point>&) override { return {}; }

  std::vector<std::vector<double>> residuals(const std::vector<Point>& points) override {
    std::vector<std::vector<double>> lists;
    for (const Point& point : points) lists.push_back(list(point));
    return lists;
  }

  /// The list at the best point; rows are described along with it. @throws if it is invalid
  std::vector<double> describe(const Point& best) {
    std::vector<double> list;
    double like = 0.0, all = 0.0;
    for (const RunDifferences& run : simulate(best)) {
      const Differences& d = run.shown();
      append(d, list);
      kind.insert(kind.end(), d.posture.size(), kPosture);
      kind.insert(kind.end(), d.force.size(), kForce);
      weight.insert(weight.end(), d.posture.size(), posture_weight(d));
      weight.insert(weight.end(), d.force.size(), force_weight(d));
      describe_instants(d.posture);
      describe_instants(d.force);
      instants += static_cast<int>(d.posture.rows());
      const Eigen::Index rows = d.posture.rows();
      if (rows < 2) continue;
      like += d.posture.topRows(rows - 1).cwiseProduct(d.posture.bottomRows(rows - 1)).sum();
      all += d.posture.topRows(rows - 1).squaredNorm();
    }
    const double alike = all > 0.0 ? std::clamp(like / all, 0.0, 0.999) : 0.0;
    repetition = (1.0 + alike) / (1.0 - alike);
    return list;
  }

  std::vector<Kind> kind;      ///< of each row
  std::vector<double> weight;  ///< of each row
  std::vector<int> instant;    ///< of each row, counted over all runs
  int instants = 0;
  /// Instants of a trajectory are no independent witnesses: so many of them count as one.
  double repetition = 1.0;

 private:
  void describe_instants(const Eigen::MatrixXd& differences) {
    for (Eigen::Index k = 0; k < differences.size(); ++k) {
      instant.push_back(instants + static_cast<int>(k % differences.rows()));
    }
  }
  std::vector<RunDifferences> simulate(const Point& point) const {
    return simulate_runs(problem_.build(point), problem_.runs(), problem_.options());
  }

  double posture_weight(const Differences& d) const {
    return std::sqrt(problem_.weights().posture / (d.joints * d.count()));
  }
  double force_weight(const Differences& d) const {
    return std::sqrt(problem_.weights().force / static_cast<double>(d.force.size()));
  }
  void append(const Differences& d, std::vector<double>& list) const {
    for (const double x : d.posture.reshaped()) list.push_back(posture_weight(d) * x);
    for (const double x : d.force.reshaped()) list.push_back(force_weight(d) * x);
  }

  std::vector<double> list(const Point& point) const {
    std::vector<double> list;
    try {
      for (const RunDifferences& run : simulate(point)) append(run.shown(), list);
    } catch (const BadInput&) {
      list.clear();
    } catch (const NumericalFailure&) {
      list.clear();
    }
    return list;
  }

  const Problem& problem_;
};

/// Noise of postures and forces from what is left. Rows that the parameters could follow count
/// less: the fit has made them small.
struct Noise {
  double posture = 0.0, force = 0.0;
  double free[2] = {0.0, 0.0};  ///< rows of each kind that the parameters could not follow

  Noise(const Stack& stack, const std::vector<double>& left, const Eigen::VectorXd& leverage) {
    double square[2] = {0.0, 0.0};
    for (std::size_t k = 0; k < left.size(); ++k) {
      const double x = stack.weight[k] > 0.0 ? left[k] / stack.weight[k] : 0.0;
      square[stack.kind[k]] += x * x;
      // Where rows repeat each other a parameter follows as many of them.
      free[stack.kind[k]] += 1.0 - stack.repetition * leverage(static_cast<Eigen::Index>(k));
    }
    constexpr double kSmallest = 1e-9;  // perfect data
    posture = std::max(kSmallest, std::sqrt(square[kPosture] / std::max(1.0, free[kPosture])));
    force = std::max(kSmallest, std::sqrt(square[kForce] / std::max(1.0, free[kForce])));
  }

  double of(Kind kind) const { return kind == kPosture ? posture : force; }
};

constexpr double kFirst = 6.0;  ///< standard deviations of noise: what a first trial should change
constexpr double kGrowth = 4.0;
constexpr int kTrials = 4;
constexpr double kLess = 0.7, kMuchLess = 0.5;
constexpr double kBehind = 0.1;  ///< of the largest share of a promise
constexpr int kPasses = 2;       ///< over all parameters: what one opens opens others
constexpr double kFelt = 2.0;    ///< standard deviations of noise that an instant should have moved

/// Lengths of a change of the list in each instant, noise at 1.
template <class List>
Eigen::ArrayXd lengths(const List& change, const Stack& stack, const Noise& noise) {
  Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(stack.instants);
  for (std::size_t k = 0; k < stack.kind.size(); ++k) {
    if (!(stack.weight[k] > 0.0)) continue;
    squares[stack.instant[k]] +=
        std::pow(change[k] / (stack.weight[k] * noise.of(stack.kind[k])), 2);
  }
  return squares.sqrt();
}

/// Derivatives that hold as far as noise leaves a parameter open, not only at the point: where a
/// step to one side changes an instant much less than they promise, they become that little. A
/// tendon that is just taut at the best point tells a lot there, and nothing as soon as it is
/// slack.
/// @param columns of the list by steps
void be_cautious(const std::vector<SearchVariable>& variables, const Point& best,
                 const std::vector<double>& left, const Noise& noise, Stack& stack,
                 std::vector<std::vector<double>>& columns) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const SearchVariable& v = variables[i];
    const std::vector<double> local = columns[i];
    const Eigen::ArrayXd promised = lengths(local, stack, noise);
    if (!(promised.maxCoeff() > 0.0)) continue;
    Eigen::ArrayXd least = promised;
    for (const double side : {-1.0, 1.0}) {
      double reach = kFirst / promised.maxCoeff();  // [steps]
      for (int trial = 0; trial < kTrials; ++trial, reach *= kGrowth) {
        Point point = best;
        point[i] = std::clamp(best[i] + side * reach * v.step, v.lower, v.upper);
        const double steps = (point[i] - best[i]) / v.step;
        if (std::abs(steps) < 1e-3 * reach) break;  // at a bound
        std::vector<double> change = stack.residuals({point}).front();
        if (change.empty()) break;  // no such robot
        for (std::size_t k = 0; k < change.size(); ++k) change[k] = (change[k] - left[k]) / steps;
        const Eigen::ArrayXd kept = lengths(change, stack, noise);
        for (std::size_t k = 0; k < change.size(); ++k) {
          const int instant = stack.instant[k];
          if (kept[instant] < std::min(kMuchLess * promised[instant], least[instant])) {
            columns[i][k] = change[k];
          }
        }
        least = (kept < kMuchLess * promised).select(least.min(kept), least);
        const bool faded = (kept < kLess * promised && promised * std::abs(steps) > kFelt).any();
        if (!faded || std::abs(steps) < 0.99 * reach) break;
      }
    }
  }
}

/// The same along the line that leaves one parameter most room, the others following: a tendon's
/// length and its spindle together keep one posture and give up another one.
/// @param sigma of the parameter [steps]   @param direction of the line, by steps
void be_cautious_along(const std::vector<SearchVariable>& variables, const Point& best,
                       const std::vector<double>& left, const Noise& noise, Stack& stack,
                       double sigma, const Eigen::VectorXd& direction, Eigen::MatrixXd& jacobian) {
  const auto here = Eigen::Map<const Eigen::VectorXd>(left.data(), jacobian.rows());
  for (const double side : {-1.0, 1.0}) {
    double reach = kFirst * sigma;
    for (int trial = 0; trial < kTrials; ++trial, reach *= kGrowth) {
      const Point point = moved(variables, best, direction, side * reach);
      Eigen::VectorXd step(direction.size());
      for (Eigen::Index i = 0; i < step.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        step[i] = (point[k] - best[k]) / variables[k].step;
      }
      const std::vector<double> list = stack.residuals({point}).front();
      if (list.empty() || !(step.squaredNorm() > 0.0)) break;
      const Eigen::VectorXd change =
          Eigen::Map<const Eigen::VectorXd>(list.data(), jacobian.rows()) - here;
      const Eigen::VectorXd promise = jacobian * step;
      const Eigen::ArrayXd kept = lengths(change, stack, noise),
                           promised = lengths(promise, stack, noise);
      for (Eigen::Index k = 0; k < jacobian.rows(); ++k) {
        const int instant = stack.instant[static_cast<std::size_t>(k)];
        if (promised[instant] < kFelt || kept[instant] > kMuchLess * promised[instant]) continue;
        // Only taken away, and from those that are behind the promise: nothing is learned here.
        const Eigen::RowVectorXd parts = jacobian.row(k).cwiseProduct(step.transpose());
        const double least = kBehind * parts.cwiseAbs().maxCoeff();
        for (Eigen::Index i = 0; i < parts.size(); ++i) {
          if (std::abs(parts[i]) >= least) jacobian(k, i) *= kept[instant] / promised[instant];
        }
      }
      const bool faded = (kept < kLess * promised && promised > kFelt).any();
      if (!faded || std::abs(step.norm()) < 0.5 * reach * direction.norm()) break;
    }
  }
}

/// A variance made of two that are estimates themselves, each from its rows (Welch-Satterthwaite).
double effective_freedom(const double (&of_kind)[2], const Noise& noise, double repetition,
                         double variance) {
  double doubt = 0.0;
  for (const Kind kind : {kPosture, kForce}) {
    doubt += std::pow(repetition * of_kind[kind], 2) * repetition / std::max(1.0, noise.free[kind]);
  }
  return doubt > 0.0 ? std::max(1.0, variance * variance / doubt) : HUGE_VAL;
}

Profile draw_profile(const Problem& problem, const std::vector<SearchVariable>& variables,
                     const Point& best, const Eigen::MatrixXd& information, std::size_t index,
                     double sigma) {
  const Eigen::VectorXd direction = following(information, index);
  Profile profile;
  profile.parameter = index;
  for (const double share : {-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5}) {
    const Point together = moved(variables, best, direction, share * sigma / variables[index].step);
    Point alone = best;
    alone[index] = together[index];
    if (!profile.value.empty() && alone[index] == profile.value.back()) continue;  // at a bound
    profile.value.push_back(alone[index]);
    // Derivatives may promise that others can help where they only spoil it.
    profile.fitness.push_back(std::min(problem.fitness(alone), problem.fitness(together)));
  }
  return profile;
}

}  // namespace

Identifiability examine(const Problem& problem, const std::vector<double>& best, int profiles) {
  Identifiability result;
  const std::vector<SearchVariable> variables = search_variables(problem.space());
  Stack stack(problem);
  const std::vector<double> left = stack.describe(best);
  auto columns = derivatives(variables, best, left, LeastSquaresOptimiser::kDifference, stack);
  const auto n = static_cast<Eigen::Index>(best.size());
  const auto rows = static_cast<Eigen::Index>(left.size());
  const double scatter =
      std::max(1e-30, Eigen::Map<const Eigen::VectorXd>(left.data(), rows).squaredNorm() /
                          static_cast<double>(std::max<Eigen::Index>(1, rows - n)));
  // The range of a parameter is knowledge too; without it some would have no error at all.
  Eigen::VectorXd range_information(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double prior = (variables[i].upper - variables[i].lower) / std::sqrt(12.0);
    result.parameters.push_back({0.0, prior, HUGE_VAL, false});
    range_information(i) = scatter * stack.repetition * std::pow(variables[i].step / prior, 2);
  }
  Eigen::MatrixXd jacobian(rows, n), information, inverse, gain;  // of the weighted list, by steps
  const auto linearise = [&] {
    information = jacobian.transpose() * jacobian;
    information.diagonal() += range_information;
    inverse = information.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
    gain = jacobian * inverse;
  };
  const auto fill = [&] {
    for (Eigen::Index i = 0; i < n; ++i) {
      jacobian.col(i) = Eigen::Map<const Eigen::VectorXd>(columns[i].data(), rows);
    }
    linearise();
  };
  fill();
  const Noise noise(stack, left, gain.cwiseProduct(jacobian).rowwise().sum());
  result.posture_noise = noise.posture;
  result.force_noise = noise.force;
  be_cautious(variables, best, left, noise, stack, columns);
  fill();

  // The fit weighs as it is told to, not as noise would have it: errors go through its gain.
  const auto work_out = [&](Eigen::Index i) {
    const double prior =
        scatter * stack.repetition * inverse.row(i).cwiseAbs2().dot(range_information.transpose());
    double of_kind[2] = {0.0, 0.0};
    for (Eigen::Index k = 0; k < rows; ++k) {
      const Kind kind = stack.kind[k];
      of_kind[kind] += std::pow(gain(k, i) * stack.weight[k] * noise.of(kind), 2);
    }
    ParameterKnowledge& p = result.parameters[i];
    const double variance = stack.repetition * (of_kind[kPosture] + of_kind[kForce]) + prior;
    p.sigma = std::sqrt(std::max(0.0, variance)) * variables[i].step;
    p.identifiable = p.sigma < kIdentifiableShare * p.prior_sigma;
    p.freedom = effective_freedom(of_kind, noise, stack.repetition, variance);
  };
  for (Eigen::Index i = 0; i < n; ++i) work_out(i);
  for (int pass = 0; pass < kPasses; ++pass) {
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!result.parameters[i].identifiable) continue;
      be_cautious_along(variables, best, left, noise, stack,
                        result.parameters[i].sigma / variables[i].step,
                        following(information, static_cast<std::size_t>(i)), jacobian);
      linearise();
    }
    for (Eigen::Index i = 0; i < n; ++i) work_out(i);
  }

  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(jacobian.transpose() * jacobian /
                                                             scatter);
  result.singular_values = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().reverse();
  const Eigen::VectorXd flattest = eigen.eigenvectors().col(0);
  result.flattest.assign(flattest.data(), flattest.data() + n);

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

identification::Estimate interval(const Identifiability& known, std::size_t parameter,
                                  double value) {
  const ParameterKnowledge& p = known.parameters[parameter];
  return identification::make_estimate(value, p.sigma, p.freedom);
}

int equilibria_needed(int unknowns, int muscles) {
  return std::max(1, (unknowns - muscles + 2) / 3);
}

}  // namespace calibration
}  // namespace anthrob
