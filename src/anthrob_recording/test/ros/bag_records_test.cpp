// Bags that are damaged, or made to take memory.
#include "anthrob_recording/bag_records.h"

#include <anthrob_msgs/MuscleStates.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/JointState.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "anthrob_core/errors.h"
#include "anthrob_recording/bag.h"

namespace anthrob {
namespace {

class DamagedBag : public ::testing::Test {
 protected:
  DamagedBag()
      : file_((std::filesystem::temp_directory_path() /
               ("anthrob_damaged_" + std::to_string(getpid()) + ".bag"))
                  .string()) {
    write_sound(rosbag::compression::Uncompressed);
  }
  ~DamagedBag() override { std::filesystem::remove(file_); }

  void write_sound(rosbag::CompressionType compression) {
    rosbag::Bag bag(file_, rosbag::bagmode::Write);
    bag.setCompression(compression);
    for (int i = 0; i < 50; ++i) {
      sensor_msgs::JointState state;
      state.header.stamp = ros::Time(1.0 + 0.01 * i);
      state.name = {"elbow", "wrist"};
      state.position = {0.001 * i, 0.0};
      bag.write("/arm/joint_states", state.header.stamp, state);
    }
    bag.close();
    bytes_ = content();
  }

  std::string content() const {
    std::ifstream in(file_, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }
  void write(const std::string& bytes) const { std::ofstream(file_, std::ios::binary) << bytes; }

  /// The bytes with a number of four bytes put in some way behind the nth appearance of a text.
  std::string with(const std::string& text, std::size_t behind, std::uint32_t value) const {
    std::string bytes = bytes_;
    const std::size_t at = bytes.find(text) + text.size() + behind;
    for (int i = 0; i < 4; ++i)
      bytes[at + static_cast<std::size_t>(i)] = static_cast<char>(value >> 8 * i);
    return bytes;
  }

  std::string answer_to(const std::string& bytes) const {
    write(bytes);
    try {
      read_bag(file_);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "accepted";
  }

  void expect_refused(const std::string& bytes, const std::string& part) const {
    const std::string said = answer_to(bytes);
    EXPECT_EQ(said.find(file_), 0u) << said;
    EXPECT_NE(said.find(part), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }

  std::string file_, bytes_;
};

TEST_F(DamagedBag, AsItWasIsAccepted) {
  EXPECT_EQ(answer_to(bytes_), "accepted");
  for (const auto compression : {rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    write_sound(compression);
    EXPECT_EQ(answer_to(bytes_), "accepted");
  }
}

TEST(BagRecords, OfNoFileAreRefused) {
  try {
    check_bag_records("/nowhere/run.bag");
    FAIL();
  } catch (const BadInput& error) {
    EXPECT_STREQ(error.what(), "/nowhere/run.bag: no such bag");
  }
}

TEST_F(DamagedBag, ThatIsCutOffIsRefused) {
  for (const std::size_t length : {5000u, 6000u, 7001u}) {
    ASSERT_LT(length, bytes_.size());
    EXPECT_NE(answer_to(bytes_.substr(0, length)), "accepted") << length;
  }
  expect_refused("", "cannot be read as a bag");
}

TEST_F(DamagedBag, AChunkThatSaysItWouldBeFourGigabytesIsRefused) {
  expect_refused(with("size=", 0, 0xf0000000u), "a chunk that says it has 4026531840 bytes");
  write_sound(rosbag::compression::LZ4);
  expect_refused(with("size=", 0, 0xf0000000u), "a chunk that says it has 4026531840 bytes");
}

TEST_F(DamagedBag, ARecordThatIsLongerThanTheFileIsRefused) {
  // The bag's own record comes first: header length, header, length of data.
  std::string bytes = bytes_;
  bytes[13 + 3] = '\x7f';
  expect_refused(bytes, "at byte 13: a record that is longer than the file");
}

TEST_F(DamagedBag, AListThatSaysItHasMillionsOfNamesIsRefused) {
  // seq, stamp, frame_id come first in a message, then the number of names.
  std::string bytes = bytes_;
  const std::size_t first = bytes.find(std::string("\x02\0\0\0\x05\0\0\0elbow", 13));
  ASSERT_NE(first, std::string::npos);
  bytes[first + 3] = '\x0c';
  expect_refused(bytes, "/arm/joint_states: malformed: a list says that it has 201326594 entries");
}

TEST_F(DamagedBag, WhateverIsDamagedIsReadOrRefused) {
  // Memory that nobody needs for 50 messages is refused by the system: then the test ends here.
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  rlimit limit = before;
  limit.rlim_cur = rlim_t{4} << 30;
  setrlimit(RLIMIT_AS, &limit);
  std::mt19937 random(1);
  int accepted = 0, refused = 0;
  for (const auto compression : {rosbag::compression::Uncompressed, rosbag::compression::LZ4}) {
    write_sound(compression);
    const std::string sound = bytes_;
    for (int i = 0; i < 400; ++i) {
      std::string bytes = sound;
      for (int k = 0; k < 1 + i % 4; ++k) {
        const std::size_t at = random() % bytes.size();
        bytes[at] = static_cast<char>(random());
      }
      ++(answer_to(bytes) == "accepted" ? accepted : refused);
    }
  }
  setrlimit(RLIMIT_AS, &before);
  EXPECT_GT(accepted, 50);
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace anthrob
