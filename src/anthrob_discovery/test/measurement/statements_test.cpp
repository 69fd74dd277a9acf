// What meta.yaml says of how a recording was taken.
#include "measurement/statements.h"

#include <gtest/gtest.h>

#include "anthrob_core/errors.h"
#include "config.h"
#include "measurement/measurement.h"

namespace anthrob {
namespace discovery {
namespace statements_test {

std::shared_ptr<const RobotModel> rig() {
  static const auto robot = load_robot_model(kConfig + "/two_muscle_rig/model_I.yaml");
  return robot;
}

/// Ten rows of each table.
Dataset recording(const std::string& measurement) {
  Dataset data;
  data.folder = "run";
  data.meta.other["measurement"] = measurement;
  for (const auto& [name, columns] : std::map<std::string, std::vector<std::string>>{
           {"muscles", {"flexor/voltage", "flexor/position", "flexor/force", "extensor/force"}},
           {"joints", {"hinge/position"}}}) {
    Table& table = data.table(name);
    for (const std::string& column : columns) table.column(column);
    for (int i = 0; i < 10; ++i) {
      table.t.push_back(static_cast<Nanoseconds>(i) * 1000000000);
      for (Column& column : table.columns) {
        column.values.push_back(1.0 + i), column.present.push_back(1);
      }
    }
  }
  return data;
}

Description stated(const std::string& measurement) {
  Question question;
  question.train = {recording(measurement)};
  return as_stated(*rig(), question);
}

std::string refusal_of(const std::string& measurement) {
  try {
    stated(measurement);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "not refused";
}

TEST(Statements, AreUndoneAndReported) {
  const Description description = stated(
      "- {channel_kind: force, what: delay, value: 0.01}\n"
      "- {channel_kind: voltage, what: tick_phase, value: 0}\n"
      "- {channel_kind: force, place: flexor, what: unit, value: 1000}\n"
      "- {channel_kind: joint position, place: joints, what: clock, value: 0.5, unit: s}\n"
      "- {channel_kind: joint position, what: clock, value: 100, unit: ppm}\n"
      "- {channel_kind: joint position, place: hinge, what: sign, value: -1}\n");
  EXPECT_TRUE(description.corrected);
  ASSERT_EQ(description.measurement.size(), 6u);
  for (const MeasurementProperty& row : description.measurement) EXPECT_EQ(row.source, "meta");
  const Dataset& data = description.question.train[0];
  EXPECT_NEAR(data.series("extensor/force").t.front(), 0.99, 1e-9);  // that before lies outside
  EXPECT_NEAR(data.series("extensor/force").values.front(), 2.0, 1e-12);
  EXPECT_NEAR(data.series("flexor/force").values.front(), 0.002, 1e-12);
  EXPECT_NEAR(data.series("flexor/voltage").t.front(), 0.001, 1e-9);
  EXPECT_NEAR(data.series("flexor/position").t[3], 3.0, 1e-9);
  const Series hinge = data.series("hinge/position");
  EXPECT_NEAR(hinge.t.front(), 1.0 - 0.5 - 1e-4 * (1.0 - 0.5), 1e-9);
  EXPECT_NEAR(hinge.values.front(), -2.0, 1e-12);
}

TEST(Statements, ThatMakeNoSenseAreRefused) {
  const std::pair<const char*, const char*> cases[] = {
      {"force\n", "expected a list"},
      {"- {channel_kind: torque, what: delay, value: 1}\n", "expected one of current, force"},
      {"- {channel_kind: force, what: later, value: 1}\n", "expected one of clock, delay"},
      {"- {channel_kind: force, what: delay}\n", "value"},
      {"- {channel_kind: force, what: delay, value: soon}\n", "soon"},
      {"- {channel_kind: force, what: delay, value: 1, unit: ms}\n", "ms: expected s"},
      {"- {channel_kind: force, what: unit, value: 0}\n", "expected a factor other than 0"},
      {"- {channel_kind: force, what: tick_phase, value: 0}\n", "expected voltage"},
      {"- {channel_kind: voltage, what: tick_phase, value: 0.5}\n", "or 0: after it"},
      {"- {channel_kind: force, what: clock, value: 1}\n", "the clock of the muscles"},
      {"- {channel_kind: force, place: triceps, what: delay, value: 1}\n", "triceps"},
      {"- {channel_kind: force, what: delay, value: 1, valu: 2}\n", "valu"}};
  for (const auto& [measurement, expected] : cases) {
    const std::string line = refusal_of(measurement);
    EXPECT_NE(line.find("run/meta.yaml"), std::string::npos) << line;
    EXPECT_NE(line.find(expected), std::string::npos) << line;
  }
}

TEST(Statements, ThatTheRecordingsContradictAreTold) {
  Description description;
  description.measurement = {{"force", "all", "delay", 0.01, {0.01, 0.01}, "s", "meta"},
                             {"joint position", "hinge", "hold", 50.0, {50.0, 50.0}, "Hz", "meta"},
                             {"joint position", "hinge", "hold", 60.0, {59.9, 60.1}, "Hz", "found"},
                             {"current", "all", "delay", 0.004, {0.003, 0.005}, "s", "found"}};
  tell_contradictions(description);
  ASSERT_EQ(description.remarks.size(), 1u);
  EXPECT_NE(description.remarks[0].find("hold of joint position (hinge) 50 Hz"), std::string::npos);
  description.measurement.push_back(
      {"force", "all", "delay", -0.01, {-0.011, -0.009}, "s", "found"});
  description.remarks.clear();
  tell_contradictions(description);
  EXPECT_EQ(description.remarks.size(), 2u);
}

}  // namespace statements_test
}  // namespace discovery
}  // namespace anthrob
