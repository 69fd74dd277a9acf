#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace anthrob {

/// Lays out a message as OMG CORBA 3.3 part 2, 9.3 says: for tests, and without the reader's code.
class CdrBytes {
 public:
  explicit CdrBytes(bool little, bool align_empty = false)
      : little_(little), align_empty_(align_empty) {}

  CdrBytes& u8(std::uint8_t value) { return raw(&value, 1); }
  CdrBytes& u32(std::uint32_t value) { return raw(&value, 4); }
  CdrBytes& f64(double value) { return raw(&value, 8); }
  CdrBytes& text(const std::string& value) {
    u32(static_cast<std::uint32_t>(value.size()) + 1);
    body_ += value;
    body_ += '\0';
    return *this;
  }
  CdrBytes& texts(const std::vector<std::string>& list) {
    u32(static_cast<std::uint32_t>(list.size()));
    for (const std::string& item : list) text(item);
    return *this;
  }
  CdrBytes& numbers(const std::vector<double>& list, std::uint32_t count) {
    u32(count);
    if (list.empty() && align_empty_) pad(8);
    for (const double item : list) f64(item);
    return *this;
  }
  CdrBytes& numbers(const std::vector<double>& list) {
    return numbers(list, static_cast<std::uint32_t>(list.size()));
  }
  CdrBytes& bytes(const std::vector<std::uint8_t>& list) {
    u32(static_cast<std::uint32_t>(list.size()));
    for (const std::uint8_t item : list) u8(item);
    return *this;
  }
  CdrBytes& header(std::int32_t sec, std::uint32_t nanosec, const std::string& frame) {
    return u32(static_cast<std::uint32_t>(sec)).u32(nanosec).text(frame);
  }
  std::string all() const {
    return std::string("\0", 1) + (little_ ? '\1' : '\0') + std::string("\0\0", 2) + body_;
  }

 private:
  void pad(std::size_t size) {
    while (body_.size() % size != 0) body_ += '\0';
  }
  CdrBytes& raw(const void* value, std::size_t size) {
    pad(size);
    char bytes[8];
    std::memcpy(bytes, value, size);  // on a machine that is little endian
    for (std::size_t i = 0; i < size; ++i) body_ += bytes[little_ ? i : size - 1 - i];
    return *this;
  }

  bool little_, align_empty_;
  std::string body_;
};

}  // namespace anthrob
