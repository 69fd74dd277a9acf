#include "hypotheses/periods.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>

namespace anthrob {
namespace discovery {

namespace {

double phase_of(double periods) {
  return 2.0 * M_PI * periods;
}

/// Frequencies that are tried.
struct FrequencyGrid {
  double first = 0.0, spacing = 0.0;
  std::size_t count = 0;
};

/// Way that the joint makes to a bin from the one before it; 0 where a recording begins.
std::vector<double> steps_of(const EffortAlongWay& data) {
  std::vector<double> steps(data.position.size(), 0.0);
  for (std::size_t i = 1; i < steps.size(); ++i) {
    if (std::binary_search(data.runs.begin(), data.runs.end(), i)) continue;
    steps[i] = std::abs(data.position[i] - data.position[i - 1]);
  }
  return steps;
}

/// A quantile of the steps of a joint that moves.
double quantile_of(std::vector<double> steps, double share) {
  steps.erase(std::remove(steps.begin(), steps.end(), 0.0), steps.end());
  if (steps.empty()) return 0.0;
  const auto at =
      steps.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(steps.size() - 1));
  std::nth_element(steps.begin(), at, steps.end());
  return *at;
}

/// Second difference of the position: acceleration, up to a factor. 0 at the ends of a recording.
double bend_at(const EffortAlongWay& data, std::size_t i) {
  const auto begins = [&](std::size_t k) {
    return std::binary_search(data.runs.begin(), data.runs.end(), k);
  };
  if (i + 1 >= data.position.size() || begins(i) || begins(i + 1)) return 0.0;
  return data.position[i + 1] - 2.0 * data.position[i] + data.position[i - 1];
}

/// A calm part of the data, with the acceleration that only the whole of it shows.
struct CalmWay : EffortAlongWay {
  std::vector<double> acceleration;
};

/// Without what is much faster than the rest: starts and returns, along which ripple is averaged
/// out and inertia counts.
CalmWay without_rushes(const EffortAlongWay& data, const PeriodOptions& options) {
  const std::vector<double> steps = steps_of(data);
  const double most = options.rush * quantile_of(steps, 0.75);
  CalmWay calm;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (std::binary_search(data.runs.begin(), data.runs.end(), i)) {
      calm.runs.push_back(calm.position.size());
    }
    const bool rushes = steps[i] > most || (i + 1 < steps.size() && steps[i + 1] > most);
    if (rushes) continue;
    calm.position.push_back(data.position[i]);
    calm.velocity.push_back(data.velocity[i]);
    calm.effort.push_back(data.effort[i]);
    calm.acceleration.push_back(bend_at(data, i));
  }
  return calm;
}

FrequencyGrid grid_of(const EffortAlongWay& data, const PeriodOptions& options) {
  const double step = quantile_of(steps_of(data), 0.5);
  if (!(step > 0.0)) return {};
  const auto [low, high] = std::minmax_element(data.position.begin(), data.position.end());
  const double range = *high - *low;
  FrequencyGrid grid;
  const double highest = options.fastest / step;
  grid.spacing =
      std::max(options.spacing / range, highest / static_cast<double>(options.most_frequencies));
  // Whole numbers are on the grid.
  if (grid.spacing < 1.0) grid.spacing = 1.0 / std::ceil(1.0 / grid.spacing);
  const double first = std::ceil(options.least_periods / range / grid.spacing);
  grid.first = first * grid.spacing;
  if (highest > grid.first) {
    grid.count = static_cast<std::size_t>((highest - grid.first) / grid.spacing) + 1;
  }
  return grid;
}

/// The series that is fitted to the effort, together with other laws of the motion.
///
/// With the acceleration beside them, periods of the effort itself are found also where a wrong
/// inertia fills a residual with what the joint jumps from one rest to the next.
class FourierFit {
 public:
  FourierFit(const CalmWay& data, const PeriodOptions& options) : data_(data) {
    const auto rows = static_cast<Eigen::Index>(data.effort.size());
    effort_ = Eigen::Map<const Eigen::VectorXd>(data.effort.data(), rows);
    columns_.resize(rows, 6);
    block_.resize(data.effort.size());
    for (Eigen::Index i = 0; i < rows; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double v = data.velocity[k];
      const double side = v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : 0.0;
      columns_.row(i) << 1.0, data.position[k], v, side, v * std::abs(v), data.acceleration[k];
      block_[k] = options.blocks * k / data.effort.size();
    }
    for (Eigen::Index c = 0; c < columns_.cols(); ++c) {
      const double norm = columns_.col(c).norm();
      if (norm > 0.0) columns_.col(c) /= norm;
    }
  }

  void add(double number) {
    columns_.conservativeResize(Eigen::NoChange, columns_.cols() + 2);
    replace(static_cast<std::size_t>(columns_.cols() - 8) / 2, number);
  }
  /// Puts another frequency in the place of the k-th.
  void replace(std::size_t k, double number) {
    const auto column = static_cast<Eigen::Index>(6 + 2 * k);
    for (Eigen::Index i = 0; i < columns_.rows(); ++i) {
      const double phase = phase_of(number * data_.position[static_cast<std::size_t>(i)]);
      columns_(i, column) = std::sin(phase);
      columns_(i, column + 1) = std::cos(phase);
    }
  }
  void drop_last() { columns_.conservativeResize(Eigen::NoChange, columns_.cols() - 2); }

  Eigen::VectorXd amplitudes() const { return solve(columns_, effort_).tail(columns_.cols() - 6); }
  Eigen::VectorXd residual() const { return effort_ - columns_ * solve(columns_, effort_); }
  /// Sum of squares that is left at times to which the series was not fitted.
  double left_elsewhere() const {
    double left = 0.0;
    for (std::size_t half = 0; half < 2; ++half) {
      Eigen::VectorXd fitted = Eigen::VectorXd::Zero(columns_.rows());
      for (Eigen::Index i = 0; i < columns_.rows(); ++i) {
        fitted[i] = block_[static_cast<std::size_t>(i)] % 2 == half ? 1.0 : 0.0;
      }
      const Eigen::VectorXd x = solve(fitted.asDiagonal() * columns_, fitted.cwiseProduct(effort_));
      const Eigen::VectorXd error = effort_ - columns_ * x;
      left += error.cwiseProduct(Eigen::VectorXd::Ones(error.size()) - fitted).squaredNorm();
    }
    return left;
  }

 private:
  static Eigen::VectorXd solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
    Eigen::MatrixXd normal = a.transpose() * a;
    // Laws that the motion does not tell apart share what they explain.
    normal.diagonal() *= 1.0 + 1e-9;
    normal.diagonal().array() += 1e-12;
    return normal.ldlt().solve(a.transpose() * b);
  }

  const EffortAlongWay& data_;
  Eigen::VectorXd effort_;
  Eigen::MatrixXd columns_;
  std::vector<std::size_t> block_;
};

/// Squared correlation with a period, up to a factor.
double height(const EffortAlongWay& data, const Eigen::VectorXd& residual, double number) {
  std::complex<double> sum = 0.0;
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    sum += std::polar(residual[i], phase_of(number * data.position[static_cast<std::size_t>(i)]));
  }
  return std::norm(sum);
}

/// The frequency on the grid that takes most of a residual.
double strongest(const EffortAlongWay& data, const Eigen::VectorXd& residual,
                 const FrequencyGrid& grid) {
  const std::size_t rows = data.position.size();
  std::vector<std::complex<double>> now(rows), turn(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    now[i] = std::polar(residual[k], phase_of(grid.first * data.position[i]));
    turn[i] = std::polar(1.0, phase_of(grid.spacing * data.position[i]));
  }
  double best = grid.first, most = -1.0;
  for (std::size_t f = 0; f < grid.count; ++f) {
    double re = 0.0, im = 0.0;
    for (std::size_t i = 0; i < rows; ++i) {
      re += now[i].real();
      im += now[i].imag();
      const double real = now[i].real() * turn[i].real() - now[i].imag() * turn[i].imag();
      now[i] = {real, now[i].real() * turn[i].imag() + now[i].imag() * turn[i].real()};
    }
    if (re * re + im * im <= most) continue;
    most = re * re + im * im;
    best = grid.first + static_cast<double>(f) * grid.spacing;
  }
  return best;
}

/// The top of a peak, or the whole number beside it if that is nearly as high.
double top_of(const EffortAlongWay& data, const Eigen::VectorXd& residual, double number,
              double reach, bool whole, double nearly) {
  double best = number, most = height(data, residual, number);
  for (double step = 0.5 * reach; step > 0.01 * reach; step *= 0.5) {
    for (const double side : {-step, step}) {
      const double there = height(data, residual, best + side);
      if (there <= most) continue;
      most = there;
      best += side;
      break;
    }
  }
  const double rounded = std::round(best);
  const bool is_near = whole && rounded >= 1.0;
  return is_near && height(data, residual, rounded) >= nearly * most ? rounded : best;
}

}  // namespace

std::vector<Period> find_periods(const EffortAlongWay& all, std::size_t most, bool whole,
                                 const PeriodOptions& options) {
  const CalmWay data = without_rushes(all, options);
  const FrequencyGrid grid = grid_of(data, options);
  if (grid.count == 0 || data.effort.size() < 2 * options.blocks) return {};
  FourierFit fit(data, options);
  const double without = fit.left_elsewhere();
  double left = without;
  std::vector<double> numbers;
  while (numbers.size() < most) {
    const Eigen::VectorXd residual = fit.residual();
    const double number =
        top_of(data, residual, strongest(data, residual, grid), grid.spacing, whole, options.whole);
    if (std::count(numbers.begin(), numbers.end(), number) > 0) break;
    fit.add(number);
    const double now = fit.left_elsewhere();
    if (left - now < options.least_share * left) {
      fit.drop_last();
      break;
    }
    left = now;
    numbers.push_back(number);
  }
  if (without - left < options.least_together * without) return {};
  for (std::size_t k = 0; whole && k < numbers.size(); ++k) {
    // Beside other periods a peak stands aside of where it belongs.
    const double rounded = std::round(numbers[k]);
    if (rounded < 1.0 || std::count(numbers.begin(), numbers.end(), rounded) > 0) continue;
    fit.replace(k, rounded);
    if (fit.left_elsewhere() - left > options.least_share * left) {
      fit.replace(k, numbers[k]);
    } else {
      numbers[k] = rounded;
    }
  }
  const Eigen::VectorXd amplitudes = fit.amplitudes();
  std::vector<Period> periods;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(2 * k);
    periods.push_back({numbers[k], amplitudes[at], amplitudes[at + 1]});
  }
  return periods;
}

}  // namespace discovery
}  // namespace anthrob
