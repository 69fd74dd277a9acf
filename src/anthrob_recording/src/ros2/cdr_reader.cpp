#include "ros2/cdr_reader.h"

#include <cstring>

namespace anthrob {
namespace {

constexpr std::size_t kHeader = 4;
// Representation identifiers of RTPS.
constexpr unsigned kBigEndian = 0x0000, kLittleEndian = 0x0001;

}  // namespace

CdrReader::CdrReader(const void* data, std::size_t size, EmptySequence empty)
    : data_(static_cast<const std::uint8_t*>(data)), empty_(empty) {
  if (size < kHeader) throw CdrError("shorter than the header of its encapsulation");
  const unsigned kind = (unsigned{data_[0]} << 8) + data_[1];
  if (kind != kBigEndian && kind != kLittleEndian) {
    throw CdrError("encapsulation " + std::to_string(kind) + ": expected 0 or 1, plain CDR");
  }
  little_ = kind == kLittleEndian;
  data_ += kHeader;
  size_ = size - kHeader;
}

void CdrReader::require(std::size_t bytes, const char* what) const {
  if (bytes <= left()) return;
  throw CdrError("ends at byte " + std::to_string(size_) + " within " + what);
}

void CdrReader::align(std::size_t alignment) {
  const std::size_t skip = (alignment - at_ % alignment) % alignment;
  require(skip, "the padding before a value");
  at_ += skip;
}

std::uint64_t CdrReader::unsigned_of(std::size_t bytes, const char* what) {
  align(bytes);
  require(bytes, what);
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    const std::size_t place = little_ ? bytes - 1 - i : i;
    value = (value << 8) | data_[at_ + place];
  }
  at_ += bytes;
  return value;
}

std::uint8_t CdrReader::byte() {
  return static_cast<std::uint8_t>(unsigned_of(1, "a byte"));
}

std::uint32_t CdrReader::count_32() {
  return static_cast<std::uint32_t>(unsigned_of(4, "a number of 32 bits"));
}

std::int32_t CdrReader::integer_32() {
  return static_cast<std::int32_t>(count_32());
}

double CdrReader::number() {
  const std::uint64_t bits = unsigned_of(8, "a number of 64 bits");
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

std::string CdrReader::text() {
  const std::size_t length = count_32();
  if (length > left()) {
    throw CdrError("a text of " + std::to_string(length) + " bytes where " +
                   std::to_string(left()) + " are left");
  }
  std::string text;
  if (length > 0) {  // CDR counts the zero, but some write none for an empty text
    if (data_[at_ + length - 1] != 0) throw CdrError("a text without its terminating zero");
    text.assign(reinterpret_cast<const char*>(data_ + at_), length - 1);
    at_ += length;
  }
  if (text.find('\0') != std::string::npos) throw CdrError("a text with a zero in it");
  return text;
}

std::size_t CdrReader::sequence(std::size_t least, std::size_t alignment) {
  const std::size_t count = count_32();
  if (count > left() / least) {
    throw CdrError("a list of " + std::to_string(count) + " where " + std::to_string(left()) +
                   " bytes are left");
  }
  if (count == 0 && empty_ == EmptySequence::kAligned) align(alignment);
  return count;
}

std::vector<std::string> CdrReader::texts() {
  std::vector<std::string> list(sequence(4, 4));
  for (std::string& item : list) item = text();
  return list;
}

std::vector<double> CdrReader::numbers() {
  std::vector<double> list(sequence(8, 8));
  for (double& item : list) item = number();
  return list;
}

std::vector<std::uint8_t> CdrReader::bytes() {
  std::vector<std::uint8_t> list(sequence(1, 1));
  for (std::uint8_t& item : list) item = byte();
  return list;
}

}  // namespace anthrob
