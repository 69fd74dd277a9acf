#include "ros2/cdr_reader.h"

#include <gtest/gtest.h>

#include <string>

namespace anthrob {
namespace {

using namespace std::string_literals;

TEST(CdrReader, AlignsFromTheEndOfTheHeader) {
  const std::string bytes =
      "\x00\x01\x00\x00"  // CDR, little endian
      "\x07"              // byte 7
      "\x00\x00\x00"      // to a multiple of 4
      "\xfe\xff\xff\xff"  // -2
      "\x03\x00\x00\x00"
      "ab\x00"                            // "ab"
      "\x00"                              // 15: to a multiple of 8
      "\x00\x00\x00\x00\x00\x00\xf8\xbf"  // -1.5
      ""s;
  CdrReader in(bytes.data(), bytes.size());
  EXPECT_EQ(in.byte(), 7);
  EXPECT_EQ(in.integer_32(), -2);
  EXPECT_EQ(in.text(), "ab");
  EXPECT_EQ(in.number(), -1.5);
  EXPECT_EQ(in.left(), 0u);
}

TEST(CdrReader, ReadsTheOtherByteOrder) {
  const std::string bytes =
      "\x00\x00\x00\x00"
      "\x00\x00\x00\x02"
      "\x40\x09\x21\xfb\x54\x44\x2d\x18"  // at 4: padded to 8 first
      ""s;
  const std::string padded = bytes.substr(0, 8) + "\0\0\0\0"s + bytes.substr(8) + bytes.substr(8);
  CdrReader in(padded.data(), padded.size());
  EXPECT_EQ(in.numbers(), (std::vector<double>{3.141592653589793, 3.141592653589793}));
}

TEST(CdrReader, RefusesWhatCannotBeBeforeItMakesRoom) {
  const auto refusal = [](const std::string& bytes, auto read) {
    try {
      CdrReader in(bytes.data(), bytes.size());
      read(in);
    } catch (const CdrError& error) {
      return std::string(error.what());
    }
    return "no error"s;
  };
  const std::string head = "\x00\x01\x00\x00"s;
  const auto numbers = [](CdrReader& in) { in.numbers(); };
  EXPECT_EQ(refusal(head + "\xff\xff\xff\xff"s, numbers),
            "a list of 4294967295 where 0 bytes are left");
  EXPECT_EQ(refusal(head + "\x02\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0"s, numbers),
            "a list of 2 where 12 bytes are left");
  EXPECT_EQ(refusal(head + "\xff\xff\xff\x7f"s
                           "ab\0"s,
                    [](CdrReader& in) { in.texts(); }),
            "a list of 2147483647 where 3 bytes are left");
  EXPECT_EQ(refusal(head + "\x03\0\0\0"s
                           "abc"s,
                    [](CdrReader& in) { in.text(); }),
            "a text without its terminating zero");
  EXPECT_EQ(refusal(head + "\x09\0\0\0"s
                           "abc\0"s,
                    [](CdrReader& in) { in.text(); }),
            "a text of 9 bytes where 4 are left");
  EXPECT_EQ(refusal("\x00\x03\x00\x00"s, numbers), "encapsulation 3: expected 0 or 1, plain CDR");
  EXPECT_EQ(refusal("\x00\x01"s, numbers), "shorter than the header of its encapsulation");
  EXPECT_EQ(refusal(head + "\0"s, [](CdrReader& in) { in.byte(), in.number(); }),
            "ends at byte 1 within the padding before a value");
}

}  // namespace
}  // namespace anthrob
