#include "anthrob_recording/resolution.h"

#include <algorithm>
#include <cmath>

namespace anthrob {

namespace {

constexpr double kMostCounts = 1e5;  ///< finer sensors have no steps to speak of

}  // namespace

double resolution_of(std::vector<double> values) {
  values.erase(std::remove_if(values.begin(), values.end(),
                              [](double value) { return !std::isfinite(value); }),
               values.end());
  const std::size_t count = values.size();
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  // Values of a fine sensor, and of none, hardly ever repeat. Two that do are neighbours.
  if (values.size() < 2 || values.size() > count / 2) return 0.0;
  double step = values[1] - values[0];
  for (std::size_t i = 1; i < values.size(); ++i) step = std::min(step, values[i] - values[i - 1]);
  if (values.back() - values.front() > kMostCounts * step) return 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double steps = (values[i] - values[i - 1]) / step;
    if (std::abs(steps - std::round(steps)) > 0.05 * steps) return 0.0;
  }
  return step;
}

double step_of_digits(const std::vector<double>& values) {
  constexpr int kFewest = 3, kMost = 7;    // as programs print
  constexpr std::size_t kTelling = 100;    // values
  constexpr double kExact = 1e-7;          // of the last digit
  const auto unit_of = [](double value) {  // of the first digit
    return std::pow(10.0, std::floor(std::log10(std::abs(value))));
  };
  std::size_t count = 0;
  int digits = kFewest;
  double squares = 0.0;  // of the first digits' units
  for (const double value : values) {
    if (!std::isfinite(value) || value == 0.0) continue;
    ++count;
    const double unit = unit_of(value);
    squares += unit * unit;
    const auto holds = [&](int d) {
      const double last = value / unit * std::pow(10.0, d - 1);
      return std::abs(last - std::round(last)) < kExact * std::pow(10.0, d - kFewest);
    };
    while (digits <= kMost && !holds(digits)) ++digits;
    if (digits > kMost) return 0.0;
  }
  if (count < kTelling) return 0.0;
  return std::sqrt(squares / static_cast<double>(count)) * std::pow(10.0, 1 - digits);
}

double white_noise(const Eigen::VectorXf& series) {
  std::vector<double> third;
  for (Eigen::Index i = 3; i < series.size(); ++i) {
    third.push_back(
        std::abs(double(series[i]) - 3.0 * series[i - 1] + 3.0 * series[i - 2] - series[i - 3]));
  }
  if (third.empty()) return 0.0;
  const auto middle = third.begin() + static_cast<std::ptrdiff_t>(third.size() / 2);
  std::nth_element(third.begin(), middle, third.end());
  return 1.4826 * *middle / std::sqrt(20.0);
}

}  // namespace anthrob
