#include "conclusion/sampled_delay.h"

#include <gtest/gtest.h>

#include "anthrob_sim/model/robot_model.h"

namespace anthrob {
namespace discovery {
namespace {

constexpr double kLongest = 0.025;

FoundEffect effect(const std::string& id, const std::string& place, const std::string& parameter,
                   double value) {
  FoundEffect found;
  found.id = id;
  found.place = place;
  FoundParameter size;
  size.name = parameter;
  size.unit = "s";
  size.value = value;
  size.low = 0.9 * value;
  size.high = 1.1 * value;
  found.parameters = {size};
  return found;
}

Answer answer_with(double delay) {
  Answer answer;
  answer.effects = {effect("joint_coulomb", "elbow", "torque", 0.1),
                    effect("mocap_delay", "global", "delay", delay),
                    effect("payload", "hand", "mass", 0.5)};
  answer.search.alternatives = {{"a", "a", "elbow", {0, 1}, 0.5, 0.0},
                                {"b", "b", "elbow", {0, 2}, 0.5, 0.0}};
  return answer;
}

TEST(SampledDelay, IsHowRecordingsWereTaken) {
  const auto robot = load_robot_model(ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml");
  const Answer answer = with_sampled_delays(answer_with(0.012), *robot, kLongest);
  ASSERT_EQ(answer.effects.size(), 2u);
  EXPECT_EQ(answer.effects[0].id, "joint_coulomb");
  EXPECT_EQ(answer.effects[1].id, "payload");
  // The arm has a shoulder and an elbow.
  ASSERT_EQ(answer.measurement.size(), 2u);
  EXPECT_EQ(answer.measurement[0].channel_kind, "joint position");
  EXPECT_EQ(answer.measurement[1].channel_kind, "orientation");
  for (const MeasurementProperty& row : answer.measurement) {
    EXPECT_EQ(row.what, "delay");
    EXPECT_EQ(row.place, "all");
    EXPECT_EQ(row.value, 0.012);
    EXPECT_EQ(row.ci95[1], 1.1 * 0.012);
    EXPECT_EQ(row.unit, "s");
    EXPECT_EQ(row.source, "found");
  }
  EXPECT_EQ(answer.remarks.back(),
            "all of kind joint position and orientation: 12 ms late, as sampling makes them: "
            "model.yaml has it as mocap_delay");
  // What stands for both of the others does so still.
  ASSERT_EQ(answer.search.alternatives.size(), 1u);
  EXPECT_EQ(answer.search.alternatives[0].id, "b");
  EXPECT_EQ(answer.search.alternatives[0].instead_of[1], 1u);
}

TEST(SampledDelay, OfControllersIsLessThanATick) {
  const auto robot = load_robot_model(ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml");
  const double tick = robot->muscles.front().controller.period;
  Answer answer;
  answer.effects = {effect("sensing_latency", "all", "delay", 0.6 * tick),
                    effect("command_latency", "biceps_brachii", "delay", 0.5 * tick),
                    effect("command_latency", "all", "delay", 1.5 * tick)};
  answer = with_sampled_delays(std::move(answer), *robot, kLongest);
  ASSERT_EQ(answer.effects.size(), 1u);
  EXPECT_EQ(answer.effects[0].place, "all");
  ASSERT_EQ(answer.measurement.size(), 2u);
  EXPECT_EQ(answer.measurement[0].channel_kind, "position and force");
  EXPECT_EQ(answer.measurement[1].channel_kind, "reference");
  EXPECT_EQ(answer.measurement[1].place, "biceps_brachii");
}

TEST(SampledDelay, MayBeTheRestOfAClocksOffset) {
  const auto robot = load_robot_model(ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml");
  Answer answer = answer_with(0.04);
  answer.measurement = {{"orientation", "joints", "clock", 0.4, {0.37, 0.43}, "s", "found"}};
  answer = with_sampled_delays(std::move(answer), *robot, kLongest);
  EXPECT_EQ(answer.effects.size(), 2u);
  EXPECT_EQ(answer.measurement.size(), 3u);
}

TEST(SampledDelay, BeyondWhatSamplingMakesIsAnEffect) {
  const auto robot = load_robot_model(ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml");
  const Answer answer = with_sampled_delays(answer_with(0.03), *robot, kLongest);
  EXPECT_EQ(answer.effects.size(), 3u);
  EXPECT_TRUE(answer.measurement.empty());
  EXPECT_TRUE(answer.remarks.empty());
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
