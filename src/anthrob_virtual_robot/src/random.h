#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "anthrob_core/random.h"

namespace anthrob::virtual_robot {

/// Random numbers that are the same everywhere: SplitMix64 and Box-Muller, not a library's
/// distributions. Streams of one seed are independent.
class Random final {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
      : state_(split_mix(seed + 0x632be59bd9b4e019ULL * (stream + 1))) {}

  /// In [0, 1).
  double uniform() {
    state_ += 0x9e3779b97f4a7c15ULL;
    return static_cast<double>(split_mix(state_) >> 11) * 0x1p-53;
  }
  double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }
  /// Equally likely on a logarithmic scale; both positive.
  double log_uniform(double lo, double hi) { return lo * std::pow(hi / lo, uniform()); }
  /// In 0 .. count - 1.
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(count));
  }
  double sign() { return uniform() < 0.5 ? -1.0 : 1.0; }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * M_PI * uniform());
  }
  template <class T>
  const T& pick(const std::vector<T>& list) {
    return list[below(list.size())];
  }

 private:
  std::uint64_t state_;
};

}  // namespace anthrob::virtual_robot
