// Columns of another sign or unit than the others.
#include "measurement/column_correction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_core/random.h"
#include "anthrob_sim/actuator/dc_motor.h"
#include "config.h"

namespace anthrob {
namespace discovery {
namespace {

std::shared_ptr<const RobotModel> made_rig() {
  static const auto robot = load_robot_model(kConfig + "/two_muscle_rig/model_I.yaml");
  return robot;
}

/// The rig's flexor follows its reference; friction of 30 % of the current is none of the motor's.
Dataset flexor(double position_factor, double velocity_factor, double current_factor,
               double joint_factor) {
  const auto& motor = dynamic_cast<const DcMotor&>(*made_rig()->muscles[0].actuator).parameters();
  const CounterRandom random(3, 1);
  std::uint64_t index = 0;
  const auto noise = [&](double size) { return size * random.normal(index++); };
  Dataset data;
  data.folder = "run";
  Table muscles, joints;
  muscles.name = "muscles", joints.name = "joints";
  for (const char* name : {"reference", "position", "velocity", "current", "voltage"}) {
    muscles.column(std::string("flexor/") + name);
  }
  for (const char* name : {"position", "velocity"}) joints.column(std::string("hinge/") + name);
  for (int i = 0; i < 2000; ++i) {
    const double t = 0.005 * i, x = 3.0 * std::sin(1.3 * t) + 0.4 * std::sin(5.0 * t),
                 v = 3.9 * std::cos(1.3 * t) + 2.0 * std::cos(5.0 * t),
                 current = 0.5 + 0.3 * std::sin(1.3 * t + 0.4);
    const double voltage =
        1.3 * motor.resistance * current + motor.back_emf_constant * motor.ratio * v + noise(0.01);
    const double values[] = {x + 0.3 * std::sin(2.0 * t), position_factor * (x + noise(1e-3)),
                             velocity_factor * (v + noise(0.02)),
                             current_factor * (current + noise(0.005)), voltage};
    const auto stamp = static_cast<Nanoseconds>(i) * 5000000;
    muscles.t.push_back(stamp), joints.t.push_back(stamp);
    for (std::size_t k = 0; k < 5; ++k) {
      muscles.columns[k].values.push_back(values[k]), muscles.columns[k].present.push_back(1);
    }
    joints.columns[0].values.push_back(0.2 * x), joints.columns[0].present.push_back(1);
    joints.columns[1].values.push_back(0.2 * joint_factor * v);
    joints.columns[1].present.push_back(1);
  }
  data.tables = {muscles, joints};
  return data;
}

Description corrected(const Dataset& recording) {
  Description description;
  description.question.train = {recording};
  description.question.test = {recording};
  correct_columns(*made_rig(), description);
  return description;
}

TEST(ColumnCorrection, NothingIsFoundInRightColumns) {
  const Description description = corrected(flexor(1.0, 1.0, 1.0, 1.0));
  EXPECT_FALSE(description.corrected);
  EXPECT_TRUE(description.measurement.empty());
  EXPECT_TRUE(description.remarks.empty());
}

TEST(ColumnCorrection, SignsAndUnitsOfEachColumnAreFoundAndUndone) {
  const double degrees = 180.0 / M_PI, rpm = 60.0 / (2.0 * M_PI);
  const struct {
    double position, velocity, current;
    const char *kind, *what;
    double value;
  } cases[] = {{-1.0, 1.0, 1.0, "position", "sign", -1.0},
               {degrees, 1.0, 1.0, "position", "unit", degrees},
               {-1000.0, 1.0, 1.0, "position", "unit", -1000.0},
               {1.0, -1.0, 1.0, "velocity", "sign", -1.0},
               {1.0, rpm, 1.0, "velocity", "unit", rpm},
               {1.0, 10.0, 1.0, "velocity", "unit", 10.0},
               {1.0, degrees, 1.0, "velocity", "unit", degrees},
               {1.0, 1.0, -1.0, "current", "sign", -1.0},
               {1.0, 1.0, 1000.0, "current", "unit", 1000.0},
               {1.0, 1.0, -0.001, "current", "unit", -0.001}};
  const Dataset right = flexor(1.0, 1.0, 1.0, 1.0);
  for (const auto& c : cases) {
    const Description description = corrected(flexor(c.position, c.velocity, c.current, 1.0));
    ASSERT_EQ(description.measurement.size(), 1u) << c.kind << " " << c.value;
    const MeasurementProperty& row = description.measurement[0];
    EXPECT_EQ(row.channel_kind, c.kind);
    EXPECT_EQ(row.what, c.what);
    EXPECT_EQ(row.place, "flexor");
    EXPECT_NEAR(row.value, c.value, 1e-9 * std::abs(c.value));
    EXPECT_EQ(description.remarks.size(), 1u);
    EXPECT_TRUE(description.corrected);
    for (const auto* group : {&description.question.train, &description.question.test}) {
      for (const char* kind : {"position", "velocity", "current"}) {
        const Series is = group->front().series(std::string("flexor/") + kind),
                     should = right.series(std::string("flexor/") + kind);
        for (std::size_t i = 0; i < is.values.size(); i += 97) {
          EXPECT_NEAR(is.values[i], should.values[i], 1e-9) << c.kind << " " << kind;
        }
      }
    }
  }
}

/// The first rows: too few to tell.
Dataset beginning_of(Dataset recording) {
  constexpr std::size_t kRows = 100;
  for (Table& table : recording.tables) {
    table.t.resize(kRows);
    for (Column& column : table.columns) column.values.resize(kRows), column.present.resize(kRows);
  }
  return recording;
}

TEST(ColumnCorrection, RecordingsThatDoNotTellAreOfTheSameMake) {
  const Dataset flipped = flexor(-1.0, 1.0, 1.0, 1.0), right = flexor(1.0, 1.0, 1.0, 1.0);
  Description description;
  description.question.train = {flipped};
  description.question.test = {beginning_of(flipped)};
  correct_columns(*made_rig(), description);
  EXPECT_EQ(description.question.test[0].series("flexor/position").values,
            beginning_of(right).series("flexor/position").values);
  EXPECT_EQ(description.measurement.size(), 1u);
  // Where others contradict each other, nobody knows.
  description = {};
  description.question.train = {flipped, right};
  description.question.test = {beginning_of(right)};
  correct_columns(*made_rig(), description);
  EXPECT_EQ(description.question.test[0].series("flexor/position").values,
            beginning_of(right).series("flexor/position").values);
}

TEST(ColumnCorrection, WhatPhysicsCanMakeIsLeftAlone) {
  for (const double factor : {0.5, 2.0, 3.0}) {
    EXPECT_TRUE(corrected(flexor(1.0, factor, factor, 1.0)).measurement.empty()) << factor;
  }
}

TEST(ColumnCorrection, OfAJointNothingSaysWhichColumnItIs) {
  const Dataset recording = flexor(1.0, 1.0, 1.0, -1.0);
  const Description description = corrected(recording);
  EXPECT_FALSE(description.corrected);
  ASSERT_EQ(description.remarks.size(), 1u);
  EXPECT_NE(description.remarks[0].find("one of the two has another sign"), std::string::npos);
  EXPECT_EQ(description.question.train[0].series("hinge/position").values,
            recording.series("hinge/position").values);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
