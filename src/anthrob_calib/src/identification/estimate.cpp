#include "identification/estimate.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace anthrob {
namespace identification {

double mean(const std::vector<double>& list, std::size_t begin, std::size_t end) {
  double sum = 0.0;
  for (std::size_t i = begin; i < end; ++i) sum += list[i];
  return sum / static_cast<double>(end - begin);
}

Estimate make_estimate(double value, double sigma, double freedom) {
  const boost::math::students_t distribution(freedom);
  const double reach = boost::math::quantile(distribution, 0.975) * sigma;
  return {value, sigma, value - reach, value + reach};
}

Estimate widened(const Estimate& estimate, double sigma) {
  const double reach = std::hypot(estimate.hi - estimate.value, kNormal95 * sigma);
  return {estimate.value, std::hypot(estimate.sigma, sigma), estimate.value - reach,
          estimate.value + reach};
}

Spread spread(const std::vector<double>& values) {
  if (values.empty()) return {};
  const double n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, values.size() > 1 ? std::sqrt(squares / (n - 1.0)) : 0.0};
}

Estimate mean_of_series(const std::vector<double>& series, std::size_t block) {
  std::vector<double> means;
  for (std::size_t begin = 0; begin + block <= series.size(); begin += block) {
    means.push_back(std::accumulate(series.begin() + static_cast<std::ptrdiff_t>(begin),
                                    series.begin() + static_cast<std::ptrdiff_t>(begin + block),
                                    0.0) /
                    static_cast<double>(block));
  }
  if (means.size() < 2) throw std::invalid_argument("mean of a series: fewer than two blocks");
  const Spread of_means = spread(means);
  const double count = static_cast<double>(means.size());
  return make_estimate(of_means.mean, of_means.deviation / std::sqrt(count), count - 1.0);
}

}  // namespace identification
}  // namespace anthrob
