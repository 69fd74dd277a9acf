#include "bus/bit_count.h"

#include <cstddef>
#include <vector>

namespace anthrob {
namespace driver {

namespace {

void append(std::vector<bool>& bits, unsigned value, int width) {
  for (int i = width - 1; i >= 0; --i) bits.push_back((value >> i & 1) != 0);
}

/// CRC-15 of CAN, polynomial 0x4599.
unsigned crc15(const std::vector<bool>& bits) {
  unsigned crc = 0;
  for (const bool bit : bits) {
    const bool invert = bit != ((crc >> 14 & 1) != 0);
    crc = (crc << 1) & 0x7FFF;
    if (invert) crc ^= 0x4599;
  }
  return crc;
}

int stuff_bits(const std::vector<bool>& bits) {
  int stuffed = 0, run = 0;
  bool last = !bits.front();
  for (const bool bit : bits) {
    run = bit == last ? run + 1 : 1;
    last = bit;
    if (run == 5) {
      // The stuff bit is the opposite and starts a new run.
      ++stuffed;
      last = !bit;
      run = 1;
    }
  }
  return stuffed;
}

}  // namespace

BitCount count_bits(const ecu::Frame& frame) {
  std::vector<bool> bits;
  append(bits, 0, 1);  // start of frame
  append(bits, frame.id, 11);
  append(bits, 0, 3);  // data frame, base format, reserved
  append(bits, frame.length, 4);
  // A length code above 8 still means 8 bytes.
  for (int i = 0; i < frame.length && i < 8; ++i)
    append(bits, frame.data[static_cast<std::size_t>(i)], 8);
  append(bits, crc15(bits), 15);
  // Delimiters, acknowledge, end of frame and pause: 1 + 2 + 7 + 3, never stuffed.
  const int stuffable = static_cast<int>(bits.size()), plain = stuffable + 13;
  return {plain, plain + stuff_bits(bits), plain + (stuffable - 1) / 4};
}

}  // namespace driver
}  // namespace anthrob
