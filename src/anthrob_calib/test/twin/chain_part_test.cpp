#include "twin/chain_part.h"

#include <gtest/gtest.h>

#include <map>

namespace anthrob {
namespace twin {
namespace {

const double kNone = kNotMeasured;

/// Two muscles and a joint.
std::vector<Channel> chain() {
  std::vector<Channel> channels;
  const auto add = [&](const std::string& owner, Quantity quantity, Topic topic) {
    Channel channel;
    channel.owner = owner;
    channel.quantity = quantity;
    channel.topic = topic;
    channels.push_back(channel);
  };
  for (const char* muscle : {"flexor", "extensor"}) {
    add(muscle, Quantity::kForce, Topic::kMuscles);
    add(muscle, Quantity::kPosition, Topic::kMuscles);
    add(muscle, Quantity::kCurrent, Topic::kMuscles);
  }
  add("elbow", Quantity::kJointPosition, Topic::kJoints);
  return channels;
}

using Row = std::vector<double>;  // by feed

/// One floor everywhere but in the given channels.
std::vector<double> gaps(const std::map<int, Row>& others) {
  const Row force = {1, 1, 1, 1}, motor = {1, 1, kNone, kNone}, joint = {1, 1, 1, kNone};
  std::vector<Row> rows = {force, motor, motor, force, motor, motor, joint};
  for (const auto& [channel, row] : others) rows[static_cast<std::size_t>(channel)] = row;
  std::vector<double> flat;
  for (const Row& row : rows) flat.insert(flat.end(), row.begin(), row.end());
  return flat;
}

std::string told(const std::map<int, Row>& others) {
  std::string text;
  for (const Finding& finding : judge(chain(), gaps(others), 3.0)) {
    text += finding.owner + ": " + words(finding.part) + "; ";
  }
  return text;
}

TEST(ChainPart, NoGap) {
  EXPECT_EQ(told({}), "");
  EXPECT_EQ(told({{0, {kNone, kNone, kNone, kNone}}, {6, {kNone, kNone, kNone, kNone}}}), "");
}

TEST(ChainPart, ForceByPostures) {
  EXPECT_EQ(told({{0, {5, 5, 6, 6}}}), "flexor: spring or tendon; ");
  // What it does to the joint, to the other muscle and to motors has that cause.
  EXPECT_EQ(told({{0, {5, 5, 6, 6}},
                  {1, {4, 4, kNone, kNone}},
                  {3, {4, 4, 4, 1}},
                  {4, {4, 4, kNone, kNone}},
                  {6, {9, 9, 9, kNone}}}),
            "flexor: spring or tendon; ");
}

TEST(ChainPart, JointByPositions) {
  EXPECT_EQ(told({{6, {7, 7, 7, kNone}}}), "elbow: joint or load; ");
  EXPECT_EQ(told({{0, {8, 8, 8, 1}}, {1, {4, 4, kNone, kNone}}, {6, {7, 7, 7, kNone}}}),
            "elbow: joint or load; ");
}

TEST(ChainPart, MotorByVoltages) {
  EXPECT_EQ(told({{1, {2, 8, kNone, kNone}}}), "flexor: motor or gear; ");
  EXPECT_EQ(told({{2, {8, 8, kNone, kNone}}, {0, {8, 8, 1, 1}}, {6, {4, 4, 1, kNone}}}),
            "flexor: motor or gear; ");
}

TEST(ChainPart, ByCommandsAlone) {
  EXPECT_EQ(told({{1, {9, 1, kNone, kNone}}}), "flexor: controller; ");
  EXPECT_EQ(told({{4, {9, 1, kNone, kNone}}, {3, {9, 1, 1, 1}}, {6, {9, 1, 1, kNone}}}),
            "extensor: controller; ");
}

TEST(ChainPart, SeveralAndTheLargest) {
  const auto findings =
      judge(chain(),
            gaps({{0, {1, 1, 1, 6}}, {4, {1, 5, kNone, kNone}}, {5, {1, 9, kNone, kNone}}}), 3.0);
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[0].part, Part::kSpring);
  EXPECT_EQ(findings[1].owner, "extensor");
  EXPECT_EQ(findings[1].part, Part::kMotor);
  EXPECT_DOUBLE_EQ(findings[1].gap, 9.0);
}

}  // namespace
}  // namespace twin
}  // namespace anthrob
