// Recordings that cannot answer, and what the noise in them is.
#include "anthrob_calib/discovery/preparation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "anthrob_sim/core/errors.h"
#include "arm.h"
#include "axis_recording.h"

namespace anthrob {
namespace discovery {
namespace {

std::string refusal(const Question& question) {
  try {
    const Evaluator evaluator(question.model_file, {}, 0.001, 1);
    prepare(evaluator, question);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "not refused";
}

TEST(Preparation, RefusesRecordingsThatCannotAnswer) {
  const Arm arm;
  Question good;
  good.model_file = ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml";
  good.train = {arm.record({}, 1, 1)};
  good.test = {arm.record({}, 1, 2)};
  EXPECT_EQ(refusal(good), "not refused");

  Question judged_by_itself = good;
  judged_by_itself.test = good.train;
  EXPECT_NE(refusal(judged_by_itself).find("expected every recording once"), std::string::npos);
  Question repeated_by_itself = good;
  repeated_by_itself.repeats = good.train;
  EXPECT_NE(refusal(repeated_by_itself).find("expected every recording once"), std::string::npos);

  Question still = good;
  for (Table& table : still.train[0].tables) {
    for (Column& column : table.columns) {
      std::fill(column.values.begin(), column.values.end(), column.values.front());
    }
  }
  EXPECT_NE(refusal(still).find("no muscle moves: nothing to learn about friction"),
            std::string::npos)
      << refusal(still);

  Question backwards = good;
  std::swap(backwards.train[0].tables[1].t[5], backwards.train[0].tables[1].t[50]);
  EXPECT_NE(refusal(backwards).find("time runs backwards"), std::string::npos);

  Question broken = good;
  broken.train[0].table("muscles").columns[3].values[7] = std::nan("");
  EXPECT_NE(refusal(broken).find("expected a finite number"), std::string::npos);

  Question late = good;
  for (Nanoseconds& t : late.train[0].table("joints").t) t += 3600000000000;
  EXPECT_NE(refusal(late).find("not synchronised"), std::string::npos) << refusal(late);

  Question brief = good;
  for (Table& table : brief.train[0].tables) {
    for (std::size_t i = 0; i < table.t.size(); ++i) table.t[i] /= 100;
  }
  EXPECT_NE(refusal(brief).find("too short"), std::string::npos);

  Question untested = good;
  untested.test.clear();
  EXPECT_NE(refusal(untested).find("--test"), std::string::npos);
  untested.test = brief.train;
  EXPECT_NE(refusal(untested).find("to judge by"), std::string::npos) << refusal(untested);
  untested.test = still.train;
  EXPECT_NE(refusal(untested).find("no muscle moves"), std::string::npos) << refusal(untested);

  Question repeated = good;
  repeated.repeats = {arm.record({}, 1, 3)};
  EXPECT_EQ(refusal(repeated), "not refused");
  repeated.repeats = {arm.record({}, 2, 2)};
  EXPECT_NE(refusal(repeated).find("expected a repeat of the commands"), std::string::npos)
      << refusal(repeated);
}

TEST(Preparation, RefusesRepeatsOfAnotherMotion) {
  Question axis = axis_question(20.4, 0.0);
  axis.repeats = {axis_recording(20.0, 0.0, 1)};  // not quite the same, as in another run
  EXPECT_EQ(refusal(axis), "not refused");
  axis.repeats = {axis_recording(20.4, 0.0, 3)};
  EXPECT_NE(refusal(axis).find("axis/position"), std::string::npos) << refusal(axis);
  EXPECT_NE(refusal(axis).find("expected a repeat of its motion"), std::string::npos);
}

TEST(Preparation, RefusesRepeatsOfWhatIsDrivenOtherwise) {
  const Arm arm;
  Question question;
  question.model_file = ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml";
  question.train = {arm.record({}, 1, 1)};
  question.test = {arm.record({}, 1, 2)};
  question.repeats = {arm.record({}, 1, 3)};
  const auto without = [](Dataset& recording, const std::string& quantity) {
    for (Table& table : recording.tables) {
      for (Column& column : table.columns) {
        if (column.quantity() == quantity) column.present.assign(table.t.size(), 0);
      }
    }
  };
  without(question.repeats[0], "reference");
  EXPECT_NE(refusal(question).find("/reference: expected it where"), std::string::npos)
      << refusal(question);
  // Driven by motor positions: by their own, then by those of another motion.
  for (auto* group : {&question.train, &question.test, &question.repeats}) {
    for (const char* quantity : {"reference", "voltage"}) without(group->front(), quantity);
  }
  EXPECT_EQ(refusal(question), "not refused");
  question.repeats = {arm.record({}, 2, 2)};
  for (const char* quantity : {"reference", "voltage"}) without(question.repeats[0], quantity);
  EXPECT_NE(refusal(question).find("/position"), std::string::npos) << refusal(question);
}

TEST(Resolution, OfSensorsThatHardlyMoved) {
  std::vector<double> two(100, 0.5);
  std::fill_n(two.begin(), 30, 0.4);
  EXPECT_NEAR(resolution_of(two), 0.1, 1e-12);
  EXPECT_EQ(resolution_of(std::vector<double>(100, 0.5)), 0.0);
  EXPECT_EQ(resolution_of({0.5, 0.4}), 0.0);
}

TEST(MeasureScales, CountsOfAnEncoderReachTheVoltagesOfItsController) {
  const Arm arm;
  const auto round_motors = [&](Dataset data, const std::string& quantity, double count) {
    for (Table& table : data.tables) {
      for (Column& column : table.columns) {
        if (column.quantity() != quantity || arm.plain->find_muscle(column.owner()) < 0) continue;
        for (double& value : column.values) value = count * std::round(value / count);
      }
    }
    return data;
  };
  constexpr double kCount = 0.02;  // [rad]
  const Dataset fine = arm.record({}, 1, 1), coarse = round_motors(fine, "position", kCount);
  const Evaluator evaluator(ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml", {}, 0.001, 1);
  const auto scales_of = [&](const Dataset& data) {
    return measure_scales(evaluator, {make_experiment(*arm.plain, data)}, {});
  };
  const std::string voltage = "biceps_brachii/voltage";
  EXPECT_EQ(scales_of(fine).at(voltage).counts, 0.0);
  // Proportional gain times the error of rounding.
  const double gain =
      arm.plain->muscles[arm.plain->find_muscle("biceps_brachii")].controller.position.proportional;
  const double expected = gain * kCount / std::sqrt(12.0);
  const ChannelScale scale = scales_of(coarse).at(voltage);
  EXPECT_GT(scale.counts, 0.4 * expected);
  EXPECT_LT(scale.counts, 1.6 * expected);
  // Nor does the voltage's own sensor take anything off them.
  const Dataset both = round_motors(coarse, "voltage", expected);
  EXPECT_NEAR(scales_of(both).at(voltage).counts, scale.counts, 1e-3 * scale.counts);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
