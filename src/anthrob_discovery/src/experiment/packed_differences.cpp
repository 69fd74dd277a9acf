#include "experiment/packed_differences.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace anthrob {
namespace discovery {

namespace {

using Index = Eigen::Index;
using Float = std::numeric_limits<float>;

/// Numbers that have a power of two in common.
const Index piece_length = 256;
/// Integers beyond it are not exact in a double.
const double most_multiples = std::ldexp(1.0, std::numeric_limits<double>::digits - 1);
/// That of the smallest float.
const int lowest_exponent = Float::min_exponent - Float::digits;
/// In place of an exponent, where numbers lie too far apart to be multiples of the same one.
const int unrounded = Float::max_exponent;

/// Largest e of which x is a multiple of 2^e. @param x not 0
int last_bit(float x) {
  int exponent = 0;
  const float mantissa = std::frexp(x, &exponent);
  auto digits = static_cast<std::int64_t>(std::ldexp(std::abs(mantissa), Float::digits));
  int e = exponent - Float::digits;
  for (; (digits & 1) == 0; digits >>= 1) ++e;
  return e;
}

/// Largest e of which all numbers are multiples of 2^e.
int common_exponent(const float* numbers, Index count) {
  int e = unrounded - 1;
  float most = 0.0f;
  for (Index i = 0; i < count; ++i) {
    if (numbers[i] != 0.0f) e = std::min(e, last_bit(numbers[i]));
    most = std::max(most, std::abs(numbers[i]));
  }
  return std::ldexp(static_cast<double>(most), -e) < most_multiples ? e : unrounded;
}

/// Of 2^e in a number of the reference; 0 where they would be too many to count.
std::int64_t multiples(const Eigen::VectorXf& reference, Index i, int e) {
  if (reference.size() == 0) return 0;
  const double value = std::ldexp(static_cast<double>(reference[i]), -e);
  return std::abs(value) < most_multiples ? static_cast<std::int64_t>(std::nearbyint(value)) : 0;
}

/// Small numbers for small ones of either sign: 0, -1, 1, -2, 2 ...
std::uint64_t folded(std::int64_t value) {
  return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}

std::int64_t unfolded(std::uint64_t value) {
  return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
}

/// Rice's code: all but the last few bits as so many ones and a zero, then those bits.
/// Golomb, IEEE Trans. Inf. Theory 12 (1966); Rice, JPL 79-22 (1979).
const unsigned most_ones = 20;  ///< instead of more of them, all bits follow
const unsigned all_bits = 64;

class BitWriter {
 public:
  void write(std::uint64_t value, unsigned bits) {
    for (unsigned i = bits; i-- > 0;) push(((value >> i) & 1) != 0);
  }
  void write_rice(std::uint64_t value, unsigned last_bits) {
    const std::uint64_t ones = value >> last_bits;
    const bool is_short = ones < most_ones;
    for (std::uint64_t i = 0; i < (is_short ? ones : most_ones); ++i) push(true);
    if (is_short) push(false);
    write(value, is_short ? last_bits : all_bits);
  }
  Packed bytes() const {
    return Eigen::Map<const Packed>(bytes_.data(), static_cast<Index>(bytes_.size()));
  }

 private:
  void push(bool bit) {
    if (free_ == 0) {
      bytes_.push_back(0);
      free_ = 8;
    }
    --free_;
    if (bit) bytes_.back() = static_cast<std::uint8_t>(bytes_.back() | (1u << free_));
  }

  std::vector<std::uint8_t> bytes_;
  unsigned free_ = 0;  ///< bits of the last byte
};

class BitReader {
 public:
  explicit BitReader(const Packed& bytes) : bytes_(bytes) {}
  std::uint64_t read(unsigned bits) {
    std::uint64_t value = 0;
    for (unsigned i = 0; i < bits; ++i) value = (value << 1) | (next() ? 1u : 0u);
    return value;
  }
  std::uint64_t read_rice(unsigned last_bits) {
    std::uint64_t ones = 0;
    while (ones < most_ones && next()) ++ones;
    if (ones == most_ones) return read(all_bits);
    return (ones << last_bits) | read(last_bits);
  }

 private:
  bool next() {
    const bool bit = ((bytes_[static_cast<Index>(at_ / 8)] >> (7 - at_ % 8)) & 1) != 0;
    ++at_;
    return bit;
  }

  const Packed& bytes_;
  std::size_t at_ = 0;
};

/// The last bits with which Rice's code of these numbers is about shortest.
unsigned last_bits_for(const std::vector<std::uint64_t>& values) {
  double sum = 0.0;
  for (const std::uint64_t value : values) sum += static_cast<double>(value);
  const double mean = sum / static_cast<double>(values.size());
  return mean < 1.0 ? 0 : static_cast<unsigned>(std::ilogb(mean));
}

}  // namespace

double rounding_of(const std::vector<double>& rows, double rows_per_bin, double share) {
  double squares = 0.0;
  for (std::size_t i = 3; i < rows.size(); ++i) {
    const double third = rows[i] - 3.0 * (rows[i - 1] - rows[i - 2]) - rows[i - 3];
    squares += third * third;
  }
  if (!(squares > 0.0) || !std::isfinite(squares)) return 0.0;
  // Third differences of white noise have 1 + 9 + 9 + 1 times its square.
  const double noise = std::sqrt(squares / (20.0 * static_cast<double>(rows.size() - 3)));
  return std::ldexp(1.0, std::ilogb(share * noise / std::sqrt(rows_per_bin)));
}

void round_differences(const Experiment& experiment, float* differences) {
  for (const Channel& channel : experiment.channels()) {
    if (channel.rounding == 0.0) continue;
    for (std::size_t b = channel.offset; b < channel.offset + channel.count; ++b) {
      const double multiples = std::nearbyint(differences[b] / channel.rounding);
      differences[b] = static_cast<float>(channel.rounding * multiples);
    }
  }
}

Packed packed(const Eigen::VectorXf& numbers, const Eigen::VectorXf& reference) {
  BitWriter out;
  out.write(static_cast<std::uint64_t>(numbers.size()), all_bits);
  std::vector<std::uint64_t> changes;
  for (Index from = 0; from < numbers.size(); from += piece_length) {
    const Index end = std::min(from + piece_length, numbers.size());
    const int e = common_exponent(numbers.data() + from, end - from);
    out.write(static_cast<std::uint64_t>(e - lowest_exponent), 16);
    if (e == unrounded) {
      for (Index i = from; i < end; ++i) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &numbers[i], sizeof(bits));
        out.write(bits, 32);
      }
      continue;
    }
    changes.clear();
    std::int64_t before = 0;
    for (Index i = from; i < end; ++i) {
      const auto own = static_cast<std::int64_t>(std::ldexp(static_cast<double>(numbers[i]), -e));
      const std::int64_t left = own - multiples(reference, i, e);
      changes.push_back(folded(left - before));
      before = left;
    }
    const unsigned last_bits = last_bits_for(changes);
    out.write(last_bits, 8);
    for (const std::uint64_t change : changes) out.write_rice(change, last_bits);
  }
  return out.bytes();
}

Eigen::VectorXf unpacked(const Packed& bytes, const Eigen::VectorXf& reference) {
  BitReader in(bytes);
  Eigen::VectorXf numbers(static_cast<Index>(in.read(all_bits)));
  for (Index from = 0; from < numbers.size(); from += piece_length) {
    const Index end = std::min(from + piece_length, numbers.size());
    const int e = static_cast<int>(in.read(16)) + lowest_exponent;
    if (e == unrounded) {
      for (Index i = from; i < end; ++i) {
        const auto bits = static_cast<std::uint32_t>(in.read(32));
        std::memcpy(&numbers[i], &bits, sizeof(bits));
      }
      continue;
    }
    const auto last_bits = static_cast<unsigned>(in.read(8));
    std::int64_t left = 0;
    for (Index i = from; i < end; ++i) {
      left += unfolded(in.read_rice(last_bits));
      const std::int64_t own = left + multiples(reference, i, e);
      numbers[i] = static_cast<float>(std::ldexp(static_cast<double>(own), e));
    }
  }
  return numbers;
}

}  // namespace discovery
}  // namespace anthrob
