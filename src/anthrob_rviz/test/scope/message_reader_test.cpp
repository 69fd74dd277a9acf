#include "scope/message_reader.h"

#include <anthrob_msgs/MomentArms.h>
#include <anthrob_msgs/MusclePaths.h>
#include <anthrob_msgs/MuscleStates.h>
#include <anthrob_msgs/SphericalJointStates.h>
#include <gtest/gtest.h>
#include <ros/serialization.h>
#include <sensor_msgs/JointState.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <random>

namespace anthrob {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Bytes at whose end the memory ends, too: whoever reads beyond is killed.
class GuardedBytes {
 public:
  explicit GuardedBytes(const Bytes& bytes)
      : size_(bytes.size()), page_(static_cast<std::size_t>(sysconf(_SC_PAGESIZE))) {
    length_ = (size_ / page_ + 2) * page_;
    base_ = static_cast<std::uint8_t*>(
        mmap(nullptr, length_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    mprotect(base_ + length_ - page_, page_, PROT_NONE);
    if (size_ > 0) std::memcpy(base_ + length_ - page_ - size_, bytes.data(), size_);
  }
  ~GuardedBytes() { munmap(base_, length_); }
  GuardedBytes(const GuardedBytes&) = delete;
  GuardedBytes& operator=(const GuardedBytes&) = delete;
  const std::uint8_t* data() const { return base_ + length_ - page_ - size_; }

 private:
  std::size_t size_, page_, length_ = 0;
  std::uint8_t* base_ = nullptr;
};

template <class Message>
Bytes bytes_of(const Message& message) {
  Bytes bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

template <class Message>
MessageReader reader_for(const std::string& topic) {
  return {topic, parse_definition(ros::message_traits::DataType<Message>::value(),
                                  ros::message_traits::Definition<Message>::value())};
}

template <class Message>
std::optional<MessageNumbers> numbers_of(const Message& message) {
  MessageReader reader = reader_for<Message>("/topic");
  const Bytes bytes = bytes_of(message);
  return reader.read(bytes.data(), bytes.size());
}

const Quantity* quantity_at(const MessageNumbers& numbers, const std::string& path) {
  for (const Quantity& quantity : numbers.contents->quantities) {
    if (quantity.path == path) return &quantity;
  }
  return nullptr;
}

double value_of(const MessageNumbers& numbers, const std::string& path) {
  const Quantity* quantity = quantity_at(numbers, path);
  if (quantity == nullptr) return std::nan("");
  return numbers.values[static_cast<std::size_t>(quantity - numbers.contents->quantities.data())];
}

anthrob_msgs::MuscleStates muscle_states() {
  anthrob_msgs::MuscleStates message;
  message.header.stamp = ros::Time(12, 345);
  message.name = {"biceps_brachii", "triceps"};
  message.position = {0.1, 0.2}, message.velocity = {1.1, 1.2}, message.force = {30.5, 0.1 + 0.2};
  message.mode = {1, 3}, message.ecu_state = {2, 4};
  return message;
}

TEST(MessageReaderTest, NamesAndUnitsOfMuscles) {
  const auto numbers = numbers_of(muscle_states());
  ASSERT_TRUE(numbers);
  EXPECT_EQ(numbers->stamp, 12000000345);
  EXPECT_EQ(value_of(*numbers, "/topic/force/triceps"), 0.1 + 0.2);
  EXPECT_EQ(value_of(*numbers, "/topic/ecu_state/triceps"), 4.0);
  const Quantity* force = quantity_at(*numbers, "/topic/force/biceps_brachii");
  ASSERT_NE(force, nullptr);
  EXPECT_EQ(force->unit, "N");
  EXPECT_EQ(force->group, "/topic/force");
  EXPECT_EQ(force->label, "biceps_brachii");
  EXPECT_EQ(force->topic, "/topic");
  EXPECT_EQ(quantity_at(*numbers, "/topic/current/triceps"), nullptr);
}

TEST(MessageReaderTest, OtherNamesAreOtherQuantities) {
  MessageReader reader = reader_for<anthrob_msgs::MuscleStates>("/topic");
  auto message = muscle_states();
  Bytes bytes = bytes_of(message);
  const auto first = reader.read(bytes.data(), bytes.size());
  message.force[0] = 7.0;
  bytes = bytes_of(message);
  EXPECT_EQ(reader.read(bytes.data(), bytes.size())->contents, first->contents);
  message.name = {"triceps", "biceps_brachii"};
  bytes = bytes_of(message);
  const auto other = reader.read(bytes.data(), bytes.size());
  EXPECT_NE(other->contents, first->contents);
  EXPECT_EQ(value_of(*other, "/topic/force/triceps"), 7.0);
}

TEST(MessageReaderTest, NamesThatRepeatStayTwoQuantities) {
  sensor_msgs::JointState message;
  message.name = {"elbow", "elbow", ""};
  message.position = {1.0, 2.0, 3.0};
  const auto numbers = numbers_of(message);
  EXPECT_EQ(value_of(*numbers, "/topic/position/elbow"), 1.0);
  EXPECT_EQ(value_of(*numbers, "/topic/position/elbow[1]"), 2.0);
  EXPECT_EQ(value_of(*numbers, "/topic/position/[2]"), 3.0);
  EXPECT_FALSE(numbers->stamp) << "a stamp that is not set is none";
}

TEST(MessageReaderTest, QuaternionsHaveAnAngle) {
  anthrob_msgs::SphericalJointStates message;
  message.name = {"shoulder"};
  message.orientation.resize(1), message.angular_velocity.resize(1);
  message.orientation[0].w = -std::cos(0.3), message.orientation[0].y = -std::sin(0.3);
  message.angular_velocity[0].z = 5.0;
  const auto numbers = numbers_of(message);
  ASSERT_TRUE(numbers);
  EXPECT_NEAR(value_of(*numbers, "/topic/orientation/shoulder/angle"), 0.6, 1e-15);
  EXPECT_EQ(value_of(*numbers, "/topic/angular_velocity/shoulder/z"), 5.0);
  EXPECT_EQ(quantity_at(*numbers, "/topic/angular_velocity/shoulder/z")->unit, "rad/s");
  EXPECT_EQ(quantity_at(*numbers, "/topic/orientation/shoulder/angle")->unit, "rad");
}

TEST(MessageReaderTest, MessagesInListsAreNamedByThemselvesAndMatricesByBoth) {
  anthrob_msgs::MusclePaths paths;
  paths.muscles.resize(2);
  paths.muscles[0].name = "biceps", paths.muscles[1].name = "triceps";
  paths.muscles[1].length = 0.25, paths.muscles[1].slack = true;
  const auto numbers = numbers_of(paths);
  EXPECT_EQ(value_of(*numbers, "/topic/muscles/triceps/length"), 0.25);
  EXPECT_EQ(value_of(*numbers, "/topic/muscles/triceps/slack"), 1.0);
  anthrob_msgs::MomentArms arms;
  arms.muscle = {"a", "b", "c"}, arms.axis = {"elbow", "wrist"}, arms.arm = {1, 2, 3, 4, 5, 6};
  EXPECT_EQ(value_of(*numbers_of(arms), "/topic/arm/b/wrist"), 4.0);
}

TEST(MessageReaderTest, LongListsAreLeftOutAndSaidSo) {
  const auto definition = parse_definition("a/B", "uint8[] data\nfloat64 after\n");
  MessageReader reader("/camera", definition);
  Bytes bytes(4 + 5000 + 8, 0);
  const std::uint32_t count = 5000;
  const double after = 2.5;
  std::memcpy(bytes.data(), &count, 4);
  std::memcpy(&bytes[5004], &after, 8);
  const auto numbers = reader.read(bytes.data(), bytes.size());
  ASSERT_TRUE(numbers);
  EXPECT_EQ(numbers->values, std::vector<double>{2.5});
  EXPECT_EQ(numbers->contents->left_out, std::vector<std::string>{"/camera/data (5000 entries)"});
}

TEST(MessageReaderTest, TruncatedMessagesAreRefusedAndNeverReadBeyond) {
  anthrob_msgs::MusclePaths paths;
  paths.header.frame_id = "world";
  paths.muscles.resize(3);
  for (auto& muscle : paths.muscles) muscle.name = "muscle", muscle.contacts.resize(2);
  const Bytes muscles = bytes_of(muscle_states()), nested = bytes_of(paths);
  MessageReader of_muscles = reader_for<anthrob_msgs::MuscleStates>("/topic");
  MessageReader of_paths = reader_for<anthrob_msgs::MusclePaths>("/topic");
  for (const auto& [whole, reader] :
       {std::make_pair(&muscles, &of_muscles), std::make_pair(&nested, &of_paths)}) {
    for (std::size_t size = 0; size < whole->size(); ++size) {
      const GuardedBytes guarded(
          Bytes(whole->begin(), whole->begin() + static_cast<std::ptrdiff_t>(size)));
      EXPECT_FALSE(reader->read(guarded.data(), size)) << size;
    }
    const GuardedBytes guarded(*whole);
    EXPECT_TRUE(reader->read(guarded.data(), whole->size()));
    Bytes longer = *whole;
    longer.push_back(0);
    EXPECT_FALSE(reader->read(longer.data(), longer.size()));
  }
}

TEST(MessageReaderTest, CraftedLengthsNeverReadBeyond) {
  anthrob_msgs::MusclePaths paths;
  paths.muscles.resize(2);
  for (auto& muscle : paths.muscles) muscle.name = "muscle", muscle.contacts.resize(1);
  const Bytes sound[] = {bytes_of(muscle_states()), bytes_of(paths)};
  MessageReader readers[] = {reader_for<anthrob_msgs::MuscleStates>("/t"),
                             reader_for<anthrob_msgs::MusclePaths>("/t")};
  std::mt19937 random(7);
  for (int round = 0; round < 5000; ++round) {
    MessageReader& reader = readers[round % 2];
    Bytes bytes = sound[round % 2];
    for (int i = 0; i < 3; ++i)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    const GuardedBytes guarded(bytes);
    const auto numbers = reader.read(guarded.data(), bytes.size());
    if (numbers) {
      EXPECT_EQ(numbers->values.size(), numbers->contents->quantities.size());
    }
  }
}

TEST(MessageReaderTest, NestsWithoutBytesTakeNoTime) {
  std::string text = "T1 a\nT1 b\nT1[999999999] c\n";
  for (int i = 1; i < 25; ++i) {
    text += "===\nMSG: m/T" + std::to_string(i) + "\n";
    for (const char* name : {"a", "b", "c"})
      text += "T" + std::to_string(i + 1) + " " + name + "\n";
  }
  text += "===\nMSG: m/T25\n";
  MessageReader reader("/t", parse_definition("m/M", text));
  const auto numbers = reader.read(nullptr, 0);
  ASSERT_TRUE(numbers);
  EXPECT_TRUE(numbers->values.empty());
}

}  // namespace
}  // namespace anthrob
