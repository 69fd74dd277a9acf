#include "twin/noise_floor.h"

#include <algorithm>
#include <cmath>

#include "twin/samples.h"

namespace anthrob {
namespace twin {

NoiseFloor::NoiseFloor(const TwinOptions& options)
    : least_(static_cast<std::size_t>(options.least_noise)),
      third_(static_cast<std::size_t>(options.noise_bins)),
      scratch_(third_.size()),
      sigma_(kNotMeasured) {}

void NoiseFloor::add(double value) {
  if (!std::isfinite(value)) return part();
  if (row_ == 3) {
    third_[next_] =
        static_cast<float>(std::abs(value - 3.0 * last_[2] + 3.0 * last_[1] - last_[0]));
    next_ = (next_ + 1) % third_.size();
    count_ = std::min(count_ + 1, third_.size());
  } else {
    ++row_;
  }
  last_[0] = last_[1], last_[1] = last_[2], last_[2] = value;
}

void NoiseFloor::update() {
  if (count_ < least_) return;
  std::copy_n(third_.begin(), count_, scratch_.begin());
  const auto middle = scratch_.begin() + static_cast<std::ptrdiff_t>(count_ / 2);
  std::nth_element(scratch_.begin(), middle,
                   scratch_.begin() + static_cast<std::ptrdiff_t>(count_));
  constexpr double kNormal = 1.4826;  // deviations in a median of absolute values
  sigma_ = kNormal * static_cast<double>(*middle) / std::sqrt(20.0);
}

}  // namespace twin
}  // namespace anthrob
