#include "anthrob_recording/series.h"

#include <algorithm>

namespace anthrob {

double Series::at(double time) const {
  if (time <= t.front()) return values.front();
  if (time >= t.back()) return values.back();
  const std::size_t next = std::upper_bound(t.begin(), t.end(), time) - t.begin();
  const double share = (time - t[next - 1]) / (t[next] - t[next - 1]);
  return values[next - 1] + share * (values[next] - values[next - 1]);
}

double Series::held_at(double time) const {
  const std::size_t next = std::upper_bound(t.begin(), t.end(), time) - t.begin();
  return values[next == 0 ? 0 : next - 1];
}

double Series::acting_at(double time) const {
  constexpr double kAtFirst = 0.1;  // [s]
  if (empty()) return 0.0;
  return time >= t.front() || t.front() <= kAtFirst ? held_at(time) : 0.0;
}

bool HeldSeries::advance(double time) {
  const std::vector<double>& t = series_->t;
  const std::size_t before = passed_;
  while (passed_ < t.size() && t[passed_] <= time) ++passed_;
  const bool changed = !begun_ || passed_ != before;
  begun_ = true;
  return changed;
}

}  // namespace anthrob
