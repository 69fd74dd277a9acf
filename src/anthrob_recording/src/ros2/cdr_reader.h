#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace anthrob {

/// What a serialised message cannot be; what() says where and why.
class CdrError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads the values of one serialised message of ROS 2: an encapsulation header of four bytes (OMG
/// DDSI-RTPS 2.3, 10.2), and after it plain CDR (OMG CORBA 3.3 part 2, 9.3): primitives at
/// multiples of their size from the end of the header, strings with their terminating zero,
/// sequences after a count of 32 bits. Counts are compared with what is left before room is made.
class CdrReader {
 public:
  /// How an empty sequence of numbers is laid out. CDR has nothing after its count; some writers, such
  /// as Fast CDR until 2016, skip to where its first number would have stood.
  enum class EmptySequence { kNothing, kAligned };

  /// @throws CdrError unless the header says plain CDR, in either byte order
  CdrReader(const void* data, std::size_t size, EmptySequence empty = EmptySequence::kNothing);

  std::uint8_t byte();
  std::uint32_t count_32();
  std::int32_t integer_32();
  double number();
  std::string text();

  /// The count of a sequence.
  /// @param least bytes that each element has at least   @param alignment of its first number
  /// @throws CdrError if so many elements do not fit into what is left
  std::size_t sequence(std::size_t least, std::size_t alignment);
  std::vector<std::string> texts();
  std::vector<double> numbers();
  std::vector<std::uint8_t> bytes();

  /// Bytes that were not read.
  std::size_t left() const { return size_ - at_; }

 private:
  void align(std::size_t alignment);
  void require(std::size_t bytes, const char* what) const;
  std::uint64_t unsigned_of(std::size_t bytes, const char* what);

  const std::uint8_t* data_;  ///< after the header
  std::size_t size_ = 0, at_ = 0;
  bool little_ = true;
  EmptySequence empty_;
};

}  // namespace anthrob
