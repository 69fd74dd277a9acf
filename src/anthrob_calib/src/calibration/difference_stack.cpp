#include "anthrob_calib/calibration/difference_stack.h"

#include <algorithm>
#include <cmath>

#include "anthrob_sim/core/errors.h"

namespace anthrob {
namespace calibration {

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
  for (const Point& point : points) lists.push_back(list(point));
  return lists;
}

std::vector<double> DifferenceStack::describe(const Point& best) {
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

void DifferenceStack::describe_instants(const Eigen::MatrixXd& differences) {
  for (Eigen::Index k = 0; k < differences.size(); ++k) {
    instant.push_back(instants + static_cast<int>(k % differences.rows()));
  }
}

std::vector<RunDifferences> DifferenceStack::simulate(const Point& point) const {
  before_each_();
  return simulate_runs(problem_.build(point), problem_.runs(), problem_.options());
}

double DifferenceStack::posture_weight(const Differences& d) const {
  return std::sqrt(problem_.weights().posture / (d.joints * d.count()));
}

double DifferenceStack::force_weight(const Differences& d) const {
  return std::sqrt(problem_.weights().force / static_cast<double>(d.force.size()));
}

void DifferenceStack::append(const Differences& d, std::vector<double>& list) const {
  for (const double x : d.posture.reshaped()) list.push_back(posture_weight(d) * x);
  for (const double x : d.force.reshaped()) list.push_back(force_weight(d) * x);
}

std::vector<double> DifferenceStack::list(const Point& point) const {
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

ResidualNoise::ResidualNoise(const DifferenceStack& stack, const std::vector<double>& left,
                             const Eigen::VectorXd& leverage) {
  constexpr int kPosture = DifferenceStack::kPosture, kForce = DifferenceStack::kForce;
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

}  // namespace calibration
}  // namespace anthrob
