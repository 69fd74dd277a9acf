#pragma once

#include <cstdint>

#include "anthrob_ecu/frame.h"

namespace anthrob {
namespace ecu {

/// A number inside a frame: bits `start` to `start + width - 1` in little-endian order ("Intel" in
/// a .dbc), value = scale * raw.
struct Field {
  int start;
  int width;
  bool is_signed = false;
  double scale = 1.0;

  constexpr double lowest() const {
    return is_signed ? -scale * static_cast<double>(std::int64_t{1} << (width - 1)) : 0.0;
  }
  constexpr double highest() const {
    return scale * static_cast<double>((std::int64_t{1} << (is_signed ? width - 1 : width)) - 1);
  }
};

inline std::uint64_t all_bits(const Frame& frame) {
  std::uint64_t bits = 0;
  for (int i = 7; i >= 0; --i) bits = bits << 8 | frame.data[static_cast<std::size_t>(i)];
  return bits;
}

inline void put_raw(Frame& frame, const Field& field, std::uint64_t raw) {
  const std::uint64_t mask = ((std::uint64_t{1} << field.width) - 1) << field.start;
  const std::uint64_t bits = (all_bits(frame) & ~mask) | (raw << field.start & mask);
  for (int i = 0; i < 8; ++i) {
    frame.data[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(bits >> (8 * i));
  }
}

inline std::uint64_t get_raw(const Frame& frame, const Field& field) {
  return all_bits(frame) >> field.start & ((std::uint64_t{1} << field.width) - 1);
}

/// Rounds to the nearest step; what does not fit becomes the nearest that does, NaN becomes 0.
inline void put(Frame& frame, const Field& field, double value) {
  double steps = 0.0;
  if (value >= field.highest()) {
    steps = field.highest() / field.scale;
  } else if (value <= field.lowest()) {
    steps = field.lowest() / field.scale;
  } else if (value == value) {
    steps = value / field.scale;
  }
  const auto rounded = static_cast<std::int64_t>(steps < 0.0 ? steps - 0.5 : steps + 0.5);
  put_raw(frame, field, static_cast<std::uint64_t>(rounded));
}

inline double get(const Frame& frame, const Field& field) {
  std::uint64_t raw = get_raw(frame, field);
  if (field.is_signed && (raw >> (field.width - 1) & 1) != 0) {
    raw |= ~((std::uint64_t{1} << field.width) - 1);
  }
  return field.scale * static_cast<double>(static_cast<std::int64_t>(raw));
}

}  // namespace ecu
}  // namespace anthrob
