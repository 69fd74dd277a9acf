#pragma once

#include <cmath>

#include "reference_limits.h"

namespace anthrob {

/// A slider counts in whole steps.
class SliderScale {
 public:
  static constexpr int kSteps = 2000;  ///< finer than any slider has pixels

  explicit SliderScale(const ReferenceRange& range) : range_(range) {}
  int step(double value) const {
    return static_cast<int>(std::lround((range_.clipped(value) - range_.low) / width() * kSteps));
  }
  double value(int step) const { return range_.low + step * width() / kSteps; }

 private:
  double width() const { return range_.high - range_.low; }

  ReferenceRange range_;
};

}  // namespace anthrob
