#pragma once

#include <array>
#include <cstddef>

namespace anthrob {
namespace ecu {

/// Moving average over the last order + 1 samples: the linear-phase FIR low-pass of the ECU
/// (section 7.3.1), in fixed memory. Delay: order / 2 samples. Before the first sample the output
/// is zero; a filter that has seen fewer samples than its length averages those.
template <std::size_t kMaxOrder>
class FirFilter {
 public:
  /// @param order 0..kMaxOrder; larger values count as kMaxOrder
  explicit FirFilter(std::size_t order = 0)
      : length_((order < kMaxOrder ? order : kMaxOrder) + 1) {}

  double step(double sample) {
    if (count_ == length_) {
      sum_ -= samples_[next_];
    } else {
      ++count_;
    }
    samples_[next_] = sample;
    sum_ += sample;
    next_ = next_ + 1 == length_ ? 0 : next_ + 1;
    // The running sum is recomputed once per round, so that rounding errors cannot accumulate.
    if (next_ == 0) {
      sum_ = 0.0;
      for (std::size_t i = 0; i < count_; ++i) sum_ += samples_[i];
    }
    return sum_ / static_cast<double>(count_);
  }

 private:
  std::array<double, kMaxOrder + 1> samples_{};
  std::size_t length_, count_ = 0, next_ = 0;
  double sum_ = 0.0;
};

}  // namespace ecu
}  // namespace anthrob
