#include "ros2/ros2_messages.h"

#include <gtest/gtest.h>

#include "ros2/cdr_bytes.h"
#include "ros2/cdr_reader.h"

namespace anthrob {
namespace {

using namespace std::string_literals;

TopicRow row_of(const std::string& leaf, const std::string& bytes) {
  return read_ros2_message(leaf, bytes.data(), bytes.size());
}

TEST(Ros2Messages, AJointStateByteForByte) {
  const std::string bytes =
      "\x00\x01\x00\x00"      // CDR, little endian
      "\x05\x00\x00\x00"      // stamp.sec 5
      "\x00\x65\xcd\x1d"      // stamp.nanosec 500000000
      "\x01\x00\x00\x00\x00"  // frame_id ""
      "\x00\x00\x00"          // 13: to 16
      "\x01\x00\x00\x00"      // name: one
      "\x06\x00\x00\x00"
      "elbow\x00"                         // to 30
      "\x00\x00"                          // to 32
      "\x01\x00\x00\x00\x00\x00\x00\x00"  // position: one, at 40
      "\x00\x00\x00\x00\x00\x00\xe0\x3f"  // 0.5
      "\x00\x00\x00\x00"                  // velocity: none
      "\x01\x00\x00\x00"                  // effort: one, at 56, a multiple of 8
      "\x00\x00\x00\x00\x00\x00\x00\xc0"  // -2
      ""s;
  const TopicRow row = row_of("joint_states", bytes);
  EXPECT_EQ(row.stamp, 5500000000);
  EXPECT_EQ(row.frame, "");
  EXPECT_EQ(row.owners, std::vector<std::string>{"elbow"});
  EXPECT_TRUE(row.complete);
  EXPECT_EQ(row.cells, (Cells{{"elbow/position", 0.5}, {"elbow/effort", -2.0}}));
  EXPECT_EQ(bytes.substr(4), CdrBytes(true)
                                 .header(5, 500000000, "")
                                 .texts({"elbow"})
                                 .numbers({0.5})
                                 .numbers({})
                                 .numbers({-2})
                                 .all()
                                 .substr(4));
  // No beginning of it is a message.
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(row_of("joint_states", bytes.substr(0, size)), CdrError) << size;
  }
  EXPECT_THROW(row_of("joint_states", bytes + "\0\0\0\0"s), CdrError);
  EXPECT_EQ(row_of("joint_states", bytes + "\0\0\0"s).cells, row.cells);  // padding to 4
}

TEST(Ros2Messages, AllMessagesInBothByteOrdersAndBothEmptyLists) {
  for (const bool little : {true, false}) {
    for (const bool align : {true, false}) {
      const auto begin = [&] { return CdrBytes(little, align).header(-1, 999999999, "base"); };
      TopicRow row = row_of("muscle_states", begin()
                                                 .texts({"flexor", "m"})
                                                 .numbers({1, 2})
                                                 .numbers({})
                                                 .numbers({3, 4})
                                                 .numbers({})
                                                 .numbers({5, 6})
                                                 .numbers({})
                                                 .bytes({1, 3})
                                                 .bytes({})
                                                 .all());
      EXPECT_EQ(row.stamp, -1);
      EXPECT_EQ(row.frame, "base");
      EXPECT_EQ(row.cells, (Cells{{"flexor/position", 1},
                                  {"m/position", 2},
                                  {"flexor/current", 3},
                                  {"m/current", 4},
                                  {"flexor/force", 5},
                                  {"m/force", 6},
                                  {"flexor/mode", 1},
                                  {"m/mode", 3}}));
      row = row_of("muscle_command", begin().texts({"flexor"}).bytes({3}).numbers({12.5}).all());
      EXPECT_EQ(row.cells, (Cells{{"flexor/mode", 3}, {"flexor/reference", 12.5}}));
      row = row_of("joint_states",
                   begin().texts({"a", "bc"}).numbers({}).numbers({1, 2}).numbers({}).all());
      EXPECT_EQ(row.cells, (Cells{{"a/velocity", 1}, {"bc/velocity", 2}}));
      row = row_of("spherical_joint_states",
                   begin().texts({"hip"}).numbers({.1, .2, .3, .9}, 1).numbers({4, 5, 6}, 1).all());
      EXPECT_EQ(row.cells, (Cells{{"hip/w", .9},
                                  {"hip/x", .1},
                                  {"hip/y", .2},
                                  {"hip/z", .3},
                                  {"hip/wx", 4},
                                  {"hip/wy", 5},
                                  {"hip/wz", 6}}));
      CdrBytes push = begin();
      push.texts({"arm", "arm"})
          .numbers({1, 2, 3, 4, 5, 6}, 2)
          .numbers({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, 2)
          .u32(2)
          .u32(1)
          .u32(5)
          .u32(2)
          .u32(0);
      row = row_of("external_wrenches", push.all());
      ASSERT_EQ(row.cells.size(), 18u);
      EXPECT_EQ(row.owners, (std::vector<std::string>{"arm", "arm:2"}));
      EXPECT_EQ(row.cells[1], (std::pair<std::string, double>("arm:2/force_x", 7)));
      EXPECT_EQ(row.cells[17], (std::pair<std::string, double>("arm:2/point_z", 6)));
    }
  }
}

TEST(Ros2Messages, ListsOfOtherLengthsAreNotComplete) {
  EXPECT_FALSE(row_of("joint_states", CdrBytes(true)
                                          .header(1, 0, "")
                                          .texts({"a", "b"})
                                          .numbers({1})
                                          .numbers({})
                                          .numbers({})
                                          .all())
                   .complete);
  EXPECT_FALSE(row_of("muscle_command",
                      CdrBytes(true).header(1, 0, "").texts({"a"}).bytes({}).numbers({1}).all())
                   .complete);
  EXPECT_THROW(row_of("joint_states", CdrBytes(true)
                                          .header(1, 1000000000, "")
                                          .texts({})
                                          .numbers({})
                                          .numbers({})
                                          .numbers({})
                                          .all()),
               CdrError);
}

}  // namespace
}  // namespace anthrob
