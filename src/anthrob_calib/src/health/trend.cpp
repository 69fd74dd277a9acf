#include "health/trend.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace anthrob {
namespace health {

namespace {

constexpr std::size_t kLastTests = 3;    // whose median is the present
constexpr std::size_t kTrendTests = 20;  // the last ones, that tell a slope
constexpr double kSureSlope = 3.0;       // standard errors
constexpr double kMedianToSigma = 1.4826;
constexpr double kSigmasOfInterval = 2.0 * 1.96;  // of 95 %, from end to end

double median_of_values(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// Of what neighbouring tests differ by: a trend does not count. A few may agree by chance; then it
/// is at least what the intervals say.
double scatter_of(const History::Series& series, const HealthOptions& options) {
  std::vector<double> sizes, own;
  for (const Test& test : series) {
    own.push_back((test.figure.high - test.figure.low) / kSigmasOfInterval);
  }
  for (std::size_t i = 1; i < series.size(); ++i) {
    sizes.push_back(std::abs(series[i].figure.value - series[i - 1].figure.value));
  }
  const double scatter = kMedianToSigma * median_of_values(sizes) / std::sqrt(2.0);
  const bool is_known = static_cast<int>(series.size()) >= options.many_tests;
  return is_known ? scatter : std::max(scatter, median_of_values(own));
}

struct Line {
  double slope = 0.0, error = 0.0;  ///< [1/day]
};

Line line_through(const History::Series& series, double scatter) {
  const std::size_t from = series.size() - std::min(series.size(), kTrendTests);
  const auto n = static_cast<double>(series.size() - from);
  double day = 0.0, value = 0.0;
  for (std::size_t i = from; i < series.size(); ++i) {
    day += series[i].day / n, value += series[i].figure.value / n;
  }
  double square = 0.0, cross = 0.0;
  for (std::size_t i = from; i < series.size(); ++i) {
    square += std::pow(series[i].day - day, 2);
    cross += (series[i].day - day) * (series[i].figure.value - value);
  }
  if (!(square > 0.0)) return {};
  return {cross / square, scatter / std::sqrt(square)};
}

}  // namespace

double limit_of(Quantity quantity, double normal) {
  const double size = std::abs(normal);
  switch (quantity) {
    case Quantity::kForceOffset:
      return 2.0;
    case Quantity::kStiffness:
      return 0.2 * size;
    case Quantity::kZero:
      return 1e-3;
    case Quantity::kHysteresis:
      return std::max(1.0, 0.5 * size);
    case Quantity::kFriction:
      return std::max(0.03, 0.5 * size);
    case Quantity::kCurrentGain:
    case Quantity::kResistance:
      return 0.2 * size;
    case Quantity::kCreep:
      break;
  }
  return std::max(0.05, 0.3 * size);
}

std::optional<Trend> trend_of(Quantity quantity, const History::Series& series,
                              const HealthOptions& options) {
  const auto first = static_cast<std::size_t>(options.first_tests);
  if (static_cast<int>(series.size()) < options.fewest_tests) return {};
  Trend trend;
  std::vector<double> last;
  for (std::size_t i = 0; i < first; ++i) {
    trend.normal += series[i].figure.value / static_cast<double>(first);
  }
  for (std::size_t i = series.size() - kLastTests; i < series.size(); ++i) {
    last.push_back(series[i].figure.value);
  }
  trend.now = median_of_values(last);
  trend.limit = limit_of(quantity, trend.normal);
  trend.scatter = scatter_of(series, options);
  const double error = trend.scatter * std::sqrt(1.0 / static_cast<double>(first) + 0.5);
  const double few = 1.0 + options.few_tests / static_cast<double>(series.size());
  trend.visible = std::max(options.sure * few * error, options.least_scatter * trend.limit);
  trend.is_certain = std::abs(trend.change()) > trend.visible;
  const Line line = line_through(series, std::max(trend.scatter, 1e-300));
  trend.per_day = line.slope;
  if (!trend.is_certain) return trend;
  if (std::abs(trend.change()) >= trend.limit) {
    trend.days = 0.0;
  } else if (std::abs(line.slope) > kSureSlope * line.error && line.slope * trend.change() > 0.0) {
    trend.days = (trend.limit - std::abs(trend.change())) / std::abs(line.slope);
  }
  return trend;
}

}  // namespace health
}  // namespace anthrob
