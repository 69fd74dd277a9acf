#include "identification/capstan_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "identification/least_squares.h"
#include "identification/number_text.h"

namespace anthrob {
namespace identification {

namespace {

double sign(const SlidingPoint& point) {
  return point.pulling ? 1.0 : -1.0;
}

/// Which parameters there are, and where.
struct Layout {
  std::optional<std::size_t> pulling, relaxing, offset;
  std::size_t count = 0;

  explicit Layout(const std::vector<SlidingPoint>& points) {
    double least = points.front().load, most = least;
    bool pull = false, relax = false;
    for (const SlidingPoint& point : points) {
      least = std::min(least, point.load);
      most = std::max(most, point.load);
      (point.pulling ? pull : relax) = true;
    }
    if (pull) pulling = count++;
    if (relax) relaxing = count++;
    if (most > 1.1 * least) offset = count++;
  }
};

/// An error of the angle goes straight into the coefficient.
Estimate with_angle_error(const Estimate& mu, double relative) {
  return widened(mu, mu.value * relative);
}

/// Refuses friction that pulls along: the directions are those of the encoder.
void require_friction(const CapstanFit& result, const Fit& fit,
                      const std::vector<SlidingPoint>& points) {
  const std::string& name = points.front().recording;
  if (fit.at_bound) {
    throw BadInput(name + ": tendon/force: " + significant(points.front().force.value, 3) +
                   " N at " + significant(points.front().load, 3) +
                   " N of weight/load: the fit of the friction ends at its bound; expected forces "
                   "near the load. Check unit and sign of both columns");
  }
  if (result.both.value > 0.0) return;
  throw BadInput(name + ": tendon/position: mu_k is " + significant(result.both.value, 3) +
                 " by its direction: expected a positive number; reverse the sign of the column, "
                 "which grows while the line is pulled");
}

}  // namespace

double capstan_coefficient(const SlidingPoint& point, double offset) {
  return sign(point) * std::log((point.force.value - offset) / point.load) / point.turning;
}

double CapstanFit::predicted_force(const SlidingPoint& point) const {
  const auto& own = point.pulling ? pulling : relaxing;
  const double mu = own ? own->value : both.value;
  return point.load * std::exp(sign(point) * mu * point.turning) + (offset ? offset->value : 0.0);
}

CapstanFit fit_capstan(const std::vector<SlidingPoint>& points, double turning_sigma) {
  if (points.empty()) throw BadInput("no steady motion over the eyelet in any recording");
  const Layout layout(points);
  if (points.size() <= layout.count) {
    throw BadInput(
        std::to_string(points.size()) +
        " pieces of steady motion are too few; expected several loads, each pulled and relaxed");
  }
  LeastSquares problem;
  problem.residual_count = points.size();
  problem.parameters.resize(layout.count, {0.15, 0.1, -5.0, 5.0});
  if (layout.offset) problem.parameters[*layout.offset] = {0.0, 1.0, -1e3, 1e3};
  // Relative to the load: friction scatters with it.
  problem.evaluate = [&](const double* p, double* r, double* j) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const SlidingPoint& point = points[i];
      const std::size_t own = point.pulling ? *layout.pulling : *layout.relaxing;
      const double ratio = std::exp(sign(point) * p[own] * point.turning);
      const double offset = layout.offset ? p[*layout.offset] : 0.0;
      r[i] = ratio + (offset - point.force.value) / point.load;
      if (!j) continue;
      double* row = j + i * layout.count;
      std::fill(row, row + layout.count, 0.0);
      row[own] = sign(point) * point.turning * ratio;
      if (layout.offset) row[*layout.offset] = 1.0 / point.load;
    }
  };
  const Fit fit = solve(problem);

  CapstanFit result;
  double least_turning = points.front().turning;
  for (const SlidingPoint& point : points) least_turning = std::min(least_turning, point.turning);
  const double angle_error = turning_sigma / least_turning;  // that of the others is smaller
  const auto take = [&](std::size_t index) {
    return with_angle_error(fit.estimate(index), angle_error);
  };
  if (layout.pulling) result.pulling = take(*layout.pulling);
  if (layout.relaxing) result.relaxing = take(*layout.relaxing);
  if (layout.offset) result.offset = fit.estimate(*layout.offset);
  if (result.pulling && result.relaxing) {
    const double variance = 0.25 * fit.covariance.topLeftCorner<2, 2>().sum();
    result.both =
        with_angle_error(make_estimate(0.5 * (result.pulling->value + result.relaxing->value),
                                       std::sqrt(variance), fit.freedom),
                         angle_error);
  } else {
    result.both = result.pulling ? *result.pulling : *result.relaxing;
  }
  require_friction(result, fit, points);
  return result;
}

double capstan_error(const CapstanFit& fit, const std::vector<SlidingPoint>& points) {
  double squares = 0.0;
  for (const SlidingPoint& point : points) {
    const double error = fit.predicted_force(point) - point.force.value;
    squares += error * error;
  }
  return std::sqrt(squares / static_cast<double>(points.size()));
}

}  // namespace identification
}  // namespace anthrob
