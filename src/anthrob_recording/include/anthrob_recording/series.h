#pragma once

#include <cstddef>
#include <vector>

namespace anthrob {

/// A quantity over time, without the rows in which it was not measured.
struct Series {
  std::vector<double> t;  ///< [s] since the start of the recording
  std::vector<double> values;

  bool empty() const { return t.empty(); }
  /// Value interpolated linearly between samples, constant beyond the ends.
  double at(double time) const;
  /// Value of the last sample not later than `time`; before the first sample, that of the first.
  double held_at(double time) const;
  /// For efforts and loads: as held_at(), but 0 before the first sample if that comes later than
  /// 0.1 s.
  double acting_at(double time) const;
};

/// Fast Series::held_at() for times that never decrease, as in a simulation run. It continues the
/// search at the last sample, and says when a new sample begins to hold.
class HeldSeries {
 public:
  /// @param series must outlive this
  explicit HeldSeries(const Series& series) : series_(&series) {}

  /// Advances to `time`. @return whether a new sample holds since the last call; true at the first
  bool advance(double time);
  /// Value of the current sample; the series must not be empty.
  double value() const { return series_->values[passed_ == 0 ? 0 : passed_ - 1]; }

 private:
  const Series* series_;
  std::size_t passed_ = 0;  ///< samples not later than the last time
  bool begun_ = false;
};

}  // namespace anthrob
