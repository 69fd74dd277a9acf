#include "experiment/axis_motion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "anthrob_recording/resolution.h"

namespace anthrob {
namespace discovery {

namespace {

struct SampleRange {
  std::ptrdiff_t from, to;
};

/// Samples of a polynomial at `time`: those within its half width, and at least so many.
SampleRange samples_around(const Series& series, double time, double half_width,
                           const AxisOptions& options) {
  const double reach = half_width * (1.0 + 1e-9);
  const auto first = std::lower_bound(series.t.begin(), series.t.end(), time - reach);
  const auto last = std::upper_bound(series.t.begin(), series.t.end(), time + reach);
  SampleRange range{first - series.t.begin(), last - series.t.begin()};
  const auto size = static_cast<std::ptrdiff_t>(series.t.size());
  while (range.to - range.from < options.fewest_samples && (range.from > 0 || range.to < size)) {
    if (range.from > 0) --range.from;
    if (range.to < size) ++range.to;
  }
  return range;
}

/// Position and velocity at `time` by a polynomial through the samples around it.
std::pair<double, double> motion_at(const Series& series, double time, double half_width,
                                    int degree, const AxisOptions& options) {
  const auto [from, to] = samples_around(series, time, half_width, options);
  Eigen::MatrixXd basis(to - from, std::min<std::ptrdiff_t>(degree + 1, to - from));
  Eigen::VectorXd values(to - from);
  // From the first value on, so that a small motion far from zero keeps its digits; times in half
  // widths, so that the fit is well conditioned.
  const double origin = series.values[static_cast<std::size_t>(from)];
  for (auto i = from; i < to; ++i) {
    const double dt = (series.t[static_cast<std::size_t>(i)] - time) / half_width;
    double power = 1.0;
    for (Eigen::Index k = 0; k < basis.cols(); ++k, power *= dt) basis(i - from, k) = power;
    values[i - from] = series.values[static_cast<std::size_t>(i)] - origin;
  }
  const Eigen::VectorXd polynomial = basis.colPivHouseholderQr().solve(values);
  return {origin + polynomial[0], polynomial[1] / half_width};
}

/// How the slope of a polynomial scatters, for noise of 1 at samples of equal distances.
struct SlopeScatter {
  double parabola;     ///< variance [1/s^2]
  double cubic = 0.0;  ///< what a cubic has more
};

/// By orthogonal polynomials: x and x^3 - (3 n^2 - 7) / 20 x.
SlopeScatter slope_scatter(double samples, double period) {
  const double n2 = samples * samples, once = samples * (n2 - 1.0) * period * period;
  SlopeScatter scatter{12.0 / once};
  const double slope = (3.0 * n2 - 7.0) / 20.0;
  if (samples > 4.0) scatter.cubic = slope * slope * 2800.0 / (once * (n2 - 4.0) * (n2 - 9.0));
  return scatter;
}

double noise_of(const Series& series) {
  Eigen::VectorXf moved(static_cast<Eigen::Index>(series.values.size()));
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    moved[static_cast<Eigen::Index>(i)] =
        static_cast<float>(series.values[i] - series.values.front());
  }
  return std::max(white_noise(moved), resolution_of(series.values) / std::sqrt(12.0));
}

double mean_square_of_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

}  // namespace

AxisMotion::AxisMotion(const Series& position, double bin, std::size_t bins,
                       const AxisOptions& options)
    : bin_(bin) {
  const double half_width = options.smoothing.value * bin, period = usual_period(position);
  const double samples = std::max(static_cast<double>(options.fewest_samples),
                                  2.0 * std::floor(half_width / period + 1e-9) + 1.0);
  const double noise = noise_of(position);
  const SlopeScatter scatter = slope_scatter(samples, period);
  take_edges(position, half_width, bins, 2, options);
  double variance = scatter.parabola;
  if (samples >= options.cubic_samples) {
    AxisMotion cubic = *this;
    cubic.take_edges(position, half_width, bins, 3, options);
    // Of the two, the one that is less wrong: by flattening the motion, or by its noise, which is
    // in their difference as well.
    if (mean_square_of_difference(velocity_, cubic.velocity_) >
        2.0 * scatter.cubic * noise * noise) {
      *this = std::move(cubic);
      variance += scatter.cubic;
    }
  }
  // Counts are no white noise: a slow motion keeps one for long.
  rest_speed_ = std::max(options.surely_moves * noise * std::sqrt(variance),
                         resolution_of(position.values) / (samples * period));
}

void AxisMotion::take_edges(const Series& position, double half_width, std::size_t bins, int degree,
                            const AxisOptions& options) {
  position_.clear();
  velocity_.clear();
  for (std::size_t edge = 0; edge <= bins; ++edge) {
    const auto [q, u] =
        motion_at(position, static_cast<double>(edge) * bin_, half_width, degree, options);
    position_.push_back(q);
    velocity_.push_back(u);
  }
}

double AxisMotion::position(double time) const {
  if (time <= 0.0) return position_.front() + time * velocity_.front();
  const auto last = position_.size() - 2;
  const auto b = std::min(last, static_cast<std::size_t>(time / bin_));
  const double s = time / bin_ - static_cast<double>(b);
  const double moved = position_[b + 1] - position_[b];
  // Cubic of Hermite, from the bin's first edge on.
  return position_[b] + moved * s * s * (3.0 - 2.0 * s) +
         bin_ * s * (1.0 - s) * (velocity_[b] * (1.0 - s) - velocity_[b + 1] * s);
}

bool AxisMotion::moves(std::size_t b) const {
  const double direction = std::copysign(1.0, mean_velocity(b));
  return direction * velocity_[b] > rest_speed_ && direction * velocity_[b + 1] > rest_speed_ &&
         direction * mean_velocity(b) > rest_speed_;
}

double usual_period(const Series& series) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < series.t.size(); ++i) {
    periods.push_back(series.t[i] - series.t[i - 1]);
  }
  if (periods.empty()) return 0.0;
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle;
}

std::vector<std::pair<double, double>> holes_of(const Series& series, double end, double bin,
                                                const AxisOptions& options) {
  const double period = usual_period(series);
  if (period == 0.0) return {{0.0, end}};
  const double longest =
      std::max(2.0 * options.smoothing.value * bin, options.most_periods * period);
  std::vector<std::pair<double, double>> holes;
  const auto add = [&](double from, double to) {
    if (to - from > longest) holes.emplace_back(from, to);
  };
  add(0.0, series.t.front());
  // Before the first sample and after the last, a polynomial has samples on one side only.
  holes.emplace_back(-HUGE_VAL, series.t.front() - period);
  holes.emplace_back(series.t.back() + period, HUGE_VAL);
  for (std::size_t i = 1; i < series.t.size(); ++i) add(series.t[i - 1], series.t[i]);
  add(series.t.back(), end);
  return holes;
}

}  // namespace discovery
}  // namespace anthrob
