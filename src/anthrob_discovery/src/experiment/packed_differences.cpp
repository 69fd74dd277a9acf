#include "experiment/packed_differences.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
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

/// Seven bits a byte, the lowest first; the eighth tells that more follow.
void append_number(std::string& bytes, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes.push_back(static_cast<char>(value | 0x80));
  bytes.push_back(static_cast<char>(value));
}

/// @param at first byte of the number; moved behind it
std::uint64_t number_at(const std::string& bytes, std::size_t& at) {
  std::uint64_t value = 0;
  for (unsigned shift = 0;; shift += 7) {
    const auto byte = static_cast<unsigned char>(bytes.at(at++));
    value |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
    if (byte < 0x80) return value;
  }
}

/// By zlib, behind their count.
Packed deflated(const std::string& bytes) {
  const auto count = static_cast<std::uint64_t>(bytes.size());
  uLongf length = compressBound(bytes.size());
  Packed out(static_cast<Index>(sizeof(count) + length));
  std::memcpy(out.data(), &count, sizeof(count));
  const auto* from = reinterpret_cast<const Bytef*>(bytes.data());
  if (compress2(out.data() + sizeof(count), &length, from, bytes.size(), Z_BEST_SPEED) != Z_OK) {
    throw std::runtime_error("zlib cannot compress: out of memory");
  }
  out.conservativeResize(static_cast<Index>(sizeof(count) + length));
  return out;
}

std::string inflated(const Packed& packed) {
  std::uint64_t count = 0;
  std::memcpy(&count, packed.data(), sizeof(count));
  std::string bytes(count, '\0');
  uLongf length = count;
  const auto left = static_cast<uLong>(packed.size()) - sizeof(count);
  if (uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length, packed.data() + sizeof(count),
                 left) != Z_OK) {
    throw std::runtime_error("zlib cannot uncompress what this program has compressed");
  }
  return bytes;
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
  std::string bytes;
  append_number(bytes, static_cast<std::uint64_t>(numbers.size()));
  for (Index from = 0; from < numbers.size(); from += piece_length) {
    const Index end = std::min(from + piece_length, numbers.size());
    const int e = common_exponent(numbers.data() + from, end - from);
    append_number(bytes, static_cast<std::uint64_t>(e - lowest_exponent));
    if (e == unrounded) {
      bytes.append(reinterpret_cast<const char*>(numbers.data() + from),
                   static_cast<std::size_t>(end - from) * sizeof(float));
      continue;
    }
    std::int64_t before = 0;
    for (Index i = from; i < end; ++i) {
      const auto own = static_cast<std::int64_t>(std::ldexp(static_cast<double>(numbers[i]), -e));
      const std::int64_t left = own - multiples(reference, i, e);
      append_number(bytes, folded(left - before));
      before = left;
    }
  }
  return deflated(bytes);
}

Eigen::VectorXf unpacked(const Packed& packed, const Eigen::VectorXf& reference) {
  const std::string bytes = inflated(packed);
  std::size_t at = 0;
  Eigen::VectorXf numbers(static_cast<Index>(number_at(bytes, at)));
  for (Index from = 0; from < numbers.size(); from += piece_length) {
    const Index end = std::min(from + piece_length, numbers.size());
    const int e = static_cast<int>(number_at(bytes, at)) + lowest_exponent;
    if (e == unrounded) {
      const std::size_t length = static_cast<std::size_t>(end - from) * sizeof(float);
      std::memcpy(numbers.data() + from, bytes.data() + at, length);
      at += length;
      continue;
    }
    std::int64_t left = 0;
    for (Index i = from; i < end; ++i) {
      left += unfolded(number_at(bytes, at));
      const std::int64_t own = left + multiples(reference, i, e);
      numbers[i] = static_cast<float>(std::ldexp(static_cast<double>(own), e));
    }
  }
  return numbers;
}

}  // namespace discovery
}  // namespace anthrob
