// Clocks, signs and units of the arm's joints and forces, beside what its model does.
#include <gtest/gtest.h>

#include <cmath>

#include "arm.h"
#include "measurement/leading_reference.h"
#include "measurement/measurement.h"

namespace anthrob {
namespace discovery {
namespace clock_correction_test {

/// 30 s of the arm, recorded twice.
Question arm_question() {
  const Arm arm;
  Question question;
  question.model_file = ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml";
  for (const std::uint64_t seed : {1, 2}) {
    MadeRecording made;
    made.length = 30.0;
    made.seed = made.noise = seed;
    Dataset recording = made.measure(arm.plain, made.commands(arm.plain));
    recording.folder = "run_" + std::to_string(seed);
    (seed == 1 ? question.train : question.test) = {recording};
  }
  return question;
}

Description described(const Question& question) {
  const Evaluator evaluator(question.model_file, {}, 0.001, 2);
  return describe(evaluator, as_stated(*evaluator.model(), question));
}

/// Largest difference of stamps of rows with the same values [s].
double difference(const Dataset& a, const Dataset& b, const std::string& column) {
  const Series one = a.series(column), other = b.series(column);
  double largest = 0.0;
  std::size_t k = 0;
  for (std::size_t i = 0; i < one.t.size(); ++i) {
    while (k < other.t.size() && other.values[k] != one.values[i]) ++k;
    if (k == other.t.size()) return 1e9;
    largest = std::max(largest, std::abs(one.t[i] - other.t[k]));
  }
  return largest;
}

TEST(ClockCorrection, PutsClocksOfJointsRight) {
  const Question right = arm_question();
  EXPECT_TRUE(described(right).measurement.empty());

  Question wrong = right;
  for (Dataset* recording : recordings_of(wrong)) {
    for (Nanoseconds& t : recording->table("joints").t) {
      t = static_cast<Nanoseconds>(std::llround(1.0001 * static_cast<double>(t)));
    }
  }
  const Description drifting = described(wrong);
  ASSERT_EQ(drifting.measurement.size(), 1u);
  const MeasurementProperty& drift = drifting.measurement[0];
  EXPECT_EQ(drift.what, "clock");
  EXPECT_EQ(drift.unit, "ppm");
  EXPECT_NEAR(drift.value, 100.0, 10.0);

  wrong = right;
  for (Nanoseconds& t : wrong.test[0].table("joints").t) t += 430000000;
  const Description late = described(wrong);
  ASSERT_EQ(late.measurement.size(), 1u);
  EXPECT_EQ(late.measurement[0].unit, "s");
  EXPECT_NEAR(late.measurement[0].value, 0.43, 1e-3);
  EXPECT_LT(difference(late.question.test[0], right.test[0], "elbow/position"), 1e-3);
  EXPECT_EQ(late.remarks.size(), 1u);
  EXPECT_TRUE(late.corrected);
}

TEST(ClockCorrection, OfAJointInOtherUnits) {
  const Question right = arm_question();
  Question wrong = right;
  for (Dataset* recording : recordings_of(wrong)) {
    Table& joints = recording->table("joints");
    for (Nanoseconds& t : joints.t) t += 430000000;
    for (Column& column : joints.columns) {
      if (column.name != "elbow/position") continue;
      for (double& value : column.values) value *= 0.001;
    }
  }
  const Description description = described(wrong);
  int units = 0, clocks = 0;
  for (const MeasurementProperty& row : description.measurement) {
    units += row.what == "unit" ? 1 : 0, clocks += row.what == "clock" ? 1 : 0;
  }
  EXPECT_EQ(units, 1);
  EXPECT_EQ(clocks, 2);
  const Series is = description.question.test[0].series("elbow/position"),
               should = right.test[0].series("elbow/position");
  for (double t = 2.0; t < 28.0; t += 0.37) EXPECT_NEAR(is.at(t), should.at(t), 0.02) << t;
}

TEST(ClockCorrection, GoesByTheLawThatTheRobotFollows) {
  const Arm arm;
  Question question = arm_question();
  for (Dataset* recording : recordings_of(question)) {
    MadeRecording made;
    made.length = 30.0;
    made.seed = made.noise = recording == &question.train[0] ? 1 : 2;
    const Dataset asked = made.commands(arm.plain);
    // Derivatives of errors: the robot moves as one of the model's law that is asked for more.
    Dataset led = asked;
    for (const MuscleModel& muscle : arm.plain->muscles) {
      const ecu::PositionGains& gains = muscle.controller.position;
      lead_reference(muscle.name, gains.derivative / gains.proportional, muscle.controller.period,
                     led);
    }
    Dataset moved = made.measure(arm.plain, led);
    moved.folder = recording->folder;
    moved.table("commands") = *asked.find_table("commands");
    for (Nanoseconds& t : moved.table("joints").t) t += 340000000;
    *recording = moved;
  }
  const Description late = described(question);
  int clocks = 0, laws = 0;
  for (const MeasurementProperty& row : late.measurement) {
    laws += row.what == "controller" ? 1 : 0;
    if (row.what != "clock") continue;
    ++clocks;
    EXPECT_NEAR(row.value, 0.34, 0.005) << row.unit;
  }
  EXPECT_EQ(clocks, 2);
  EXPECT_GE(laws, 1);
}

TEST(ClockCorrection, FindsSignsAndUnitsByTheModel) {
  const Question right = arm_question();
  const struct {
    const char *column, *kind, *what;
    double factor;
  } cases[] = {{"elbow/position", "joint position", "sign", -1.0},
               {"brachialis/force", "force", "unit", 1000.0},
               {"brachialis/force", "force", "unit", 1.0 / 9.80665}};
  for (const auto& c : cases) {
    Question wrong = right;
    for (Dataset* recording : recordings_of(wrong)) {
      for (Table& table : recording->tables) {
        for (Column& column : table.columns) {
          if (column.name != c.column) continue;
          for (double& value : column.values) value *= c.factor;
        }
      }
    }
    const Description description = described(wrong);
    ASSERT_EQ(description.measurement.size(), 1u) << c.column << " " << c.factor;
    EXPECT_EQ(description.measurement[0].channel_kind, c.kind);
    EXPECT_EQ(description.measurement[0].what, c.what);
    EXPECT_NEAR(description.measurement[0].value, c.factor, 1e-9);
    const Series is = description.question.test[0].series(c.column),
                 should = right.test[0].series(c.column);
    for (std::size_t i = 0; i < is.values.size(); i += 101) {
      EXPECT_NEAR(is.values[i], should.values[i], 1e-9);
    }
  }
}

}  // namespace clock_correction_test
}  // namespace discovery
}  // namespace anthrob
