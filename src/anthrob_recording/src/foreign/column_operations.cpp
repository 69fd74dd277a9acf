#include "foreign/column_operations.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace anthrob {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::vector<std::size_t> measured(const std::vector<double>& v) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (std::isfinite(v[i])) rows.push_back(i);
  }
  return rows;
}

/// Slope at `at` of the parabola through three points (Lagrange).
double slope_of_three(double at, const double (&t)[3], const double (&v)[3]) {
  double slope = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double a = t[(k + 1) % 3], b = t[(k + 2) % 3];
    slope += v[k] * (2.0 * at - a - b) / ((t[k] - a) * (t[k] - b));
  }
  return slope;
}

}  // namespace

std::vector<double> derivative_of(const std::vector<double>& t, const std::vector<double>& v) {
  std::vector<double> slope(v.size(), kNone);
  const std::vector<std::size_t> rows = measured(v);
  if (rows.size() == 2) {
    slope[rows[0]] = slope[rows[1]] = (v[rows[1]] - v[rows[0]]) / (t[rows[1]] - t[rows[0]]);
  }
  if (rows.size() < 3) return slope;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t first = std::min(i == 0 ? 0 : i - 1, rows.size() - 3);
    const std::size_t* const r = &rows[first];
    slope[rows[i]] =
        slope_of_three(t[rows[i]], {t[r[0]], t[r[1]], t[r[2]]}, {v[r[0]], v[r[1]], v[r[2]]});
  }
  return slope;
}

std::vector<double> integral_of(const std::vector<double>& t, const std::vector<double>& v,
                                double start) {
  std::vector<double> sum(v.size(), kNone);
  const std::vector<std::size_t> rows = measured(v);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t now = rows[i];
    sum[now] = start;
    if (i == 0) continue;
    const std::size_t before = rows[i - 1];
    sum[now] = sum[before] + 0.5 * (t[now] - t[before]) * (v[now] + v[before]);
  }
  return sum;
}

LocalFit fit_locally(const std::vector<double>& t, const std::vector<double>& v, double over) {
  LocalFit fit;
  fit.value = v;
  fit.slope = derivative_of(t, v);
  const std::vector<std::size_t> rows = measured(v);
  // Half a nanosecond more, the last digit of a time: which samples are inside must not depend on
  // rounding.
  const double half = 0.5 * over + 0.5e-9;
  std::size_t first = 0, end = 0;
  for (const std::size_t row : rows) {
    while (t[rows[first]] < t[row] - half) ++first;
    while (end < rows.size() && t[rows[end]] <= t[row] + half) ++end;
    fit.most = std::max(fit.most, end - first);
    if (end - first < 3) continue;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t k = first; k < end; ++k) {
      const double x = (t[rows[k]] - t[row]) / half;  // in [-1, 1]: the matrix is well scaled
      const Eigen::Vector3d powers(1.0, x, x * x);
      normal += powers * powers.transpose();
      right += powers * (v[rows[k]] - v[row]);
    }
    const Eigen::Vector3d c = normal.ldlt().solve(right);
    fit.value[row] = v[row] + c[0];
    fit.slope[row] = c[1] / half;
  }
  return fit;
}

std::vector<double> unwrapped(const std::vector<double>& v, double period) {
  std::vector<double> continuous(v);
  double last = kNone;
  for (double& value : continuous) {
    if (!std::isfinite(value)) continue;
    if (std::isfinite(last)) value -= period * std::round((value - last) / period);
    last = value;
  }
  return continuous;
}

std::vector<double> fresh_of(const std::vector<double>& v, const std::vector<double>& mark) {
  std::vector<double> fresh(v);
  double last = kNone;
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (mark[i] == last || !std::isfinite(mark[i])) fresh[i] = kNone;
    if (std::isfinite(mark[i])) last = mark[i];
  }
  return fresh;
}

}  // namespace anthrob
