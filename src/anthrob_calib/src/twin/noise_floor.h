#pragma once

#include <cstddef>
#include <vector>

#include "twin/twin_options.h"

namespace anthrob {
namespace twin {

/// White noise of one series of bins, from the median of the third differences of neighbours: what
/// is smooth, such as the error of a model, is not in it.
class NoiseFloor {
 public:
  explicit NoiseFloor(const TwinOptions& options);

  /// The next bin; NaN: nothing was compared in it.
  void add(double value);
  /// Learns anew from what comes; what was learned stays until then.
  void part() { row_ = 0; }
  /// Standard deviation; NaN before there are enough bins.
  double sigma() const { return sigma_; }
  /// Finds it from what was added. Does not allocate.
  void update();

 private:
  std::size_t least_;
  std::vector<float> third_, scratch_;
  std::size_t next_ = 0, count_ = 0;
  double last_[3] = {};
  int row_ = 0;  ///< bins in a row, up to 3
  double sigma_;
};

}  // namespace twin
}  // namespace anthrob
