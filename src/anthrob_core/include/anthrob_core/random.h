#pragma once

#include <cmath>
#include <cstdint>

namespace anthrob {

/// SplitMix64's finaliser (Steele, Lea, Flood 2014): a hash that mixes every bit into every other.
inline std::uint64_t split_mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Random numbers without state: the value is a function of (seed, stream, index), so results do
/// not depend on thread count or on how often anybody else drew, and a snapshot need not carry a
/// generator.
class CounterRandom {
 public:
  explicit CounterRandom(std::uint64_t seed = 0, std::uint64_t stream = 0)
      : key_(split_mix(split_mix(seed) + 0x9e3779b97f4a7c15ULL * (stream + 1))) {}

  /// Uniform in (0, 1).
  double uniform(std::uint64_t index) const {
    const std::uint64_t bits = split_mix(key_ + 0x9e3779b97f4a7c15ULL * (index + 1));
    return (static_cast<double>(bits >> 11) + 0.5) * 0x1.0p-53;
  }

  /// Standard normal (Box-Muller).
  double normal(std::uint64_t index) const {
    constexpr double kTwoPi = 2.0 * M_PI;
    return std::sqrt(-2.0 * std::log(uniform(2 * index))) *
           std::cos(kTwoPi * uniform(2 * index + 1));
  }

 private:
  std::uint64_t key_;
};

}  // namespace anthrob
