#pragma once

#include <array>
#include <cstdint>

namespace anthrob {
namespace ecu {

/// A classic CAN data frame with an 11-bit identifier.
struct Frame {
  std::uint16_t id = 0;
  std::uint8_t length = 0;
  std::array<std::uint8_t, 8> data{};

  bool operator==(const Frame& other) const {
    return id == other.id && length == other.length && data == other.data;
  }
};

/// CRC-8 SAE J1850 (polynomial 0x1D, start and final value 0xFF) over the identifier, high byte
/// first, and all data bytes except the last. It covers what CAN's own CRC does not: gateways,
/// memory and software at both ends. The identifier is included so that no frame is taken for
/// another.
inline std::uint8_t checksum(const Frame& frame) {
  std::uint8_t crc = 0xFF;
  const auto feed = [&crc](std::uint8_t byte) {
    crc = static_cast<std::uint8_t>(crc ^ byte);
    for (int bit = 0; bit < 8; ++bit) {
      crc = static_cast<std::uint8_t>((crc & 0x80) ? (crc << 1) ^ 0x1D : crc << 1);
    }
  };
  feed(static_cast<std::uint8_t>(frame.id >> 8));
  feed(static_cast<std::uint8_t>(frame.id & 0xFF));
  for (int i = 0; i + 1 < frame.length && i < 7; ++i) feed(frame.data[static_cast<std::size_t>(i)]);
  return static_cast<std::uint8_t>(crc ^ 0xFF);
}

}  // namespace ecu
}  // namespace anthrob
