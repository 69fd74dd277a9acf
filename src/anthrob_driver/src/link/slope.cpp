#include "link/slope.h"

#include <algorithm>
#include <limits>

namespace anthrob {
namespace driver {

void Slope::add(double t, double value) {
  if (count_ > 0) {
    const double gap = t - points_[count_ - 1].t;
    if (!(gap > 0.0 && gap <= kLongestGap)) count_ = 0;
  }
  if (count_ == kWindow) {
    std::move(points_.begin() + 1, points_.end(), points_.begin());
    --count_;
  }
  points_[count_++] = {t, value};
}

double Slope::rate() const {
  if (count_ < 2) return std::numeric_limits<double>::quiet_NaN();
  double t_mean = 0.0, value_mean = 0.0, products = 0.0, squares = 0.0;
  const double n = static_cast<double>(count_);
  // Relative to the first: clocks count from far away.
  const Point& first = points_[0];
  for (std::size_t i = 0; i < count_; ++i) {
    t_mean += (points_[i].t - first.t) / n;
    value_mean += (points_[i].value - first.value) / n;
  }
  for (std::size_t i = 0; i < count_; ++i) {
    const double dt = points_[i].t - first.t - t_mean;
    products += dt * (points_[i].value - first.value - value_mean);
    squares += dt * dt;
  }
  return products / squares;
}

}  // namespace driver
}  // namespace anthrob
