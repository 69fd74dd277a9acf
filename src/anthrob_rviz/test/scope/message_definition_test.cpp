#include "scope/message_definition.h"

#include <gtest/gtest.h>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace {

std::string refusal(const std::string& text) {
  try {
    parse_definition("my_msgs/Own", text);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "taken";
}

TEST(MessageDefinitionTest, FieldsConstantsArraysAndUnits) {
  const auto definition = parse_definition(
      "my_msgs/Own",
      "# head\nuint8 STOP = 3  # [N] none\nstring TEXT=a # b\n"
      "Header header\nfloat64[] force  # [N] tension\nint16[3] raw\n"
      "float32 range # [0, 1] of it\nother_msgs/Point[] points # [m], [rad]\n"
      "Near near\n"
      "================\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n"
      "================\nMSG: other_msgs/Point\nfloat64 x\nfloat64 y\n"
      "================\nMSG: my_msgs/Near\nbool yes\n");
  ASSERT_EQ(definition.messages.size(), 4U);
  const MessageFields& own = definition.messages[0];
  ASSERT_EQ(own.fields.size(), 6U);
  EXPECT_EQ(own.fields[1].unit, "N");
  EXPECT_EQ(own.fields[1].array, MessageField::Array::kVariable);
  EXPECT_EQ(own.fields[2].count, 3U);
  EXPECT_FALSE(own.fields[3].unit);
  EXPECT_FALSE(own.fields[4].unit);
  EXPECT_EQ(definition.messages[own.fields[5].message].type, "my_msgs/Near");
  // Header 4 + 8 + 4, two lists 4 + 4, three numbers 6, a number 4, a bool 1.
  EXPECT_EQ(own.least_size, 16U + 8U + 6U + 4U + 1U);
}

TEST(MessageDefinitionTest, WhatIsNoDefinitionIsRefused) {
  EXPECT_EQ(refusal("float64\n"), "definition of my_msgs/Own: 'float64'; expected TYPE NAME");
  EXPECT_EQ(refusal("Unknown x\n"), "definition of my_msgs/Own: the type Unknown is not defined");
  EXPECT_NE(refusal("float64[-1] x\n"), "taken");
  EXPECT_NE(refusal("float64[ x\n"), "taken");
  EXPECT_NE(refusal("float64[99999999999] x\n"), "taken");
  EXPECT_NE(refusal("float64 x y\n"), "taken");
}

TEST(MessageDefinitionTest, ATypeThatContainsItselfIsRefused) {
  EXPECT_EQ(refusal("Own[] more\n"), "definition of my_msgs/Own: it contains itself");
  EXPECT_NE(refusal("A a\n===\nMSG: my_msgs/A\nB b\n===\nMSG: my_msgs/B\nA[2] a\n"), "taken");
}

TEST(MessageDefinitionTest, HugeSizesAndDeepNestsAreFinite) {
  std::string text = "T1[999999999] x\n", deep = "T1 x\n";
  for (int i = 1; i < 100; ++i) {
    const std::string head =
        "===\nMSG: my_msgs/T" + std::to_string(i) + "\nT" + std::to_string(i + 1);
    if (i < 20) text += head + "[999999999] x\n";
    deep += head + " x\n";
  }
  text += "===\nMSG: my_msgs/T20\nfloat64 x\n";
  deep += "===\nMSG: my_msgs/T100\nfloat64 x\n";
  EXPECT_GT(parse_definition("my_msgs/Own", text).messages[0].least_size, std::uint64_t{1} << 32);
  EXPECT_NE(refusal(deep), "taken");
}

}  // namespace
}  // namespace anthrob
