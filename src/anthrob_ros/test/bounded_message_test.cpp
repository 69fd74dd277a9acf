#include "anthrob_ros/bounded_message.h"

#include <anthrob_msgs/MuscleCommand.h>
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>

#include <cstring>

namespace anthrob {
namespace {

using anthrob_msgs::MuscleCommand;

template <class M>
std::vector<std::uint8_t> bytes_of(const M& message) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream out(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(out, message);
  return bytes;
}

template <class M>
Bounded<M> read(std::vector<std::uint8_t> bytes) {
  ros::serialization::IStream in(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  Bounded<M> received;
  ros::serialization::deserialize(in, received);
  return received;
}

MuscleCommand command() {
  MuscleCommand command;
  command.header.frame_id = "somewhere";
  command.name = {"biceps", "", "a longer name than fits into a short string"};
  command.mode = {0, 1, 3};
  command.reference = {1.0, -2.5, 1e9};
  return command;
}

TEST(BoundedMessage, IsWhatWasSent) {
  const auto received = read<MuscleCommand>(bytes_of(command()));
  EXPECT_FALSE(received.refusal);
  EXPECT_EQ(bytes_of(received.message), bytes_of(command()));
  EXPECT_FALSE(read<MuscleCommand>(bytes_of(MuscleCommand())).refusal) << "an empty one";
}

TEST(BoundedMessage, ListsOfMessagesWithLists) {
  diagnostic_msgs::DiagnosticArray array;
  array.status.resize(3);
  array.status[1].values.resize(2);
  array.status[1].values[1].key = "key";
  const auto received = read<diagnostic_msgs::DiagnosticArray>(bytes_of(array));
  EXPECT_FALSE(received.refusal);
  EXPECT_EQ(bytes_of(received.message), bytes_of(array));
}

TEST(BoundedMessage, ACountBeyondTheBytesThatAreLeftIsRefusedFirst) {
  std::vector<std::uint8_t> bytes(56, 0);
  const std::uint32_t names = 33000000;  // after the header: seq, stamp, length of frame_id
  std::memcpy(&bytes[16], &names, sizeof(names));
  const auto received = read<MuscleCommand>(bytes);
  ASSERT_TRUE(received.refusal);
  EXPECT_EQ(*received.refusal,
            "malformed: a list says that it has 33000000 entries, and 36 bytes are left");
  EXPECT_TRUE(received.message.name.empty());
  EXPECT_EQ(received.message.name.capacity(), 0u);
}

TEST(BoundedMessage, NoCutAndNoFlippedByteMakesALongList) {
  const auto whole = bytes_of(command());
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const auto received =
        read<MuscleCommand>({whole.begin(), whole.begin() + static_cast<long>(length)});
    EXPECT_TRUE(received.refusal) << length;
  }
  for (std::size_t i = 0; i < whole.size(); ++i) {
    auto bytes = whole;
    bytes[i] ^= 0xff;
    const auto received = read<MuscleCommand>(bytes);
    EXPECT_LE(received.message.name.size(), whole.size() / 4);
    EXPECT_LE(received.message.reference.size(), whole.size() / 8);
  }
}

TEST(BoundedMessage, HasTheTypeOfTheMessage) {
  using ros::message_traits::datatype, ros::message_traits::md5sum;
  EXPECT_STREQ(datatype<Bounded<MuscleCommand>>(), datatype<MuscleCommand>());
  EXPECT_STREQ(md5sum<Bounded<MuscleCommand>>(), md5sum<MuscleCommand>());
}

}  // namespace
}  // namespace anthrob
