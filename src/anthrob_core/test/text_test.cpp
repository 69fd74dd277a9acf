#include "anthrob_core/text.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

TEST(Text, IsTrimmedAtBothEndsOnly) {
  EXPECT_EQ(trimmed(" a b\t\r"), "a b");
  EXPECT_EQ(trimmed("a"), "a");
  EXPECT_EQ(trimmed(" \t "), "");
  EXPECT_EQ(trimmed(""), "");
  EXPECT_EQ(trimmed("\"a\"", "\""), "a");
}

TEST(Text, WordsAreAppendedInOrder) {
  std::vector<std::string> words = {"a"};
  append({"b", "c"}, words);
  append({}, words);
  EXPECT_EQ(joined(words), "a, b, c");
}

}  // namespace
}  // namespace anthrob
