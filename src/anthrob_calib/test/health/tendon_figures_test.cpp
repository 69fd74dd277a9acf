// What a test of tendons measures, beside what is built into the robot.
#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_core/errors.h"
#include "anthrob_sim/actuator/dc_motor.h"
#include "tested_arm.h"

namespace anthrob {
namespace health {
namespace {

const std::vector<TendonFigures>& healthy() {
  static const auto figures = measure(arm_protocol(), tested({}));
  return figures;
}

const MuscleModel& muscle_named(const std::string& name) {
  return believed_arm()->muscles[static_cast<std::size_t>(believed_arm()->muscle_index(name))];
}

TEST(TestProtocol, MovesNoJointByTwoDegreesAndStaysBelowTheLimits) {
  const Dataset test = tested({});
  std::vector<double> q = Simulation(believed_arm()).configuration();
  const std::vector<double> from = q;
  const Series elbow = test.series("elbow/position");
  const Series ball[] = {test.series("shoulder/w"), test.series("shoulder/x"),
                         test.series("shoulder/y"), test.series("shoulder/z")};
  ASSERT_GT(elbow.t.size(), 5000u);
  const auto& joints = believed_arm()->skeleton->joints;
  for (std::size_t i = 0; i < elbow.t.size(); i += 10) {
    for (const JointModel& joint : joints) {
      const auto at = static_cast<std::size_t>(joint.position_offset);
      if (joint.name == "elbow") q[at] = elbow.values[i];
      for (std::size_t k = 0; k < 4 && joint.name == "shoulder"; ++k) q[at + k] = ball[k].values[i];
    }
    EXPECT_FALSE(moved_too_far(*believed_arm(), from, q, 2.0 * M_PI / 180.0)) << elbow.t[i];
  }
  for (const MuscleModel& muscle : believed_arm()->muscles) {
    for (const double force : test.series(muscle.name + "/force").values) {
      EXPECT_LT(force, HealthOptions{}.highest_tension + 10.0) << muscle.name;
    }
  }
}

TEST(TestProtocol, RefusesAPostureThatNothingBalances) {
  std::vector<double> q = Simulation(believed_arm()).configuration();
  EXPECT_NO_THROW(TestProtocol(believed_arm(), q, {}));
  HealthOptions weak;
  weak.highest_tension = 0.5;
  EXPECT_THROW(TestProtocol(believed_arm(), q, weak), BadInput);
}

TEST(TestProtocol, TellsAJointThatMoves) {
  const std::vector<double> from = Simulation(believed_arm()).configuration();
  std::vector<double> now = from;
  for (const JointModel& joint : believed_arm()->skeleton->joints) {
    if (joint.name == "elbow") now[static_cast<std::size_t>(joint.position_offset)] += 0.05;
  }
  EXPECT_FALSE(moved_too_far(*believed_arm(), from, now, 0.06));
  EXPECT_EQ(moved_too_far(*believed_arm(), from, now, 0.04), "elbow: 2.9 degrees");
}

TEST(TendonFigures, AreThoseOfTheModel) {
  for (const MuscleModel& muscle : believed_arm()->muscles) {
    const auto& motor = dynamic_cast<const DcMotor&>(*muscle.actuator).parameters();
    EXPECT_NEAR(value_of(healthy(), muscle.name, Quantity::kResistance), motor.resistance,
                0.02 * motor.resistance);
    EXPECT_NEAR(value_of(healthy(), muscle.name, Quantity::kForceOffset), 0.0, 1e-6);
    EXPECT_NEAR(value_of(healthy(), muscle.name, Quantity::kZero), 0.0, 5e-4) << muscle.name;
    // A spring that relaxes is stiffer than in the end.
    const double force = 10.0, step = 0.1;
    const double relaxed = 2.0 * step /
                           (muscle.spring->relaxed_expansion(force + step) -
                            muscle.spring->relaxed_expansion(force - step));
    EXPECT_GT(value_of(healthy(), muscle.name, Quantity::kStiffness), 0.8 * relaxed);
    EXPECT_LT(value_of(healthy(), muscle.name, Quantity::kStiffness), 2.5 * relaxed);
    EXPECT_GT(value_of(healthy(), muscle.name, Quantity::kCreep), 0.02);
  }
}

TEST(TendonFigures, ChangeByWhatHasChanged) {
  const auto& motor =
      dynamic_cast<const DcMotor&>(*muscle_named("teres_major").actuator).parameters();
  const auto changed = measure(
      arm_protocol(), tested({{"force_sensor_offset", "supraspinatus", {{"offset", 1.5}}},
                              {"force_sensor_gain", "teres_minor", {{"gain", 1.2}}},
                              {"series_resistance", "biceps_brachii", {{"resistance", 0.2}}},
                              {"motor_friction", "teres_major", {{"torque", 0.001}}},
                              {"tendon_elasticity", "anterior_deltoid", {{"compliance", 3e-4}}},
                              {"tendon_creep", "infraspinatus", {{"rate", 1e-4}}}}));
  const auto change = [&](const std::string& muscle, Quantity quantity) {
    return value_of(changed, muscle, quantity) - value_of(healthy(), muscle, quantity);
  };
  const auto ratio = [&](const std::string& muscle, Quantity quantity) {
    return value_of(changed, muscle, quantity) / value_of(healthy(), muscle, quantity);
  };
  EXPECT_NEAR(change("supraspinatus", Quantity::kForceOffset), 1.5, 0.01);
  EXPECT_NEAR(ratio("supraspinatus", Quantity::kStiffness), 1.0, 0.01);
  EXPECT_NEAR(ratio("teres_minor", Quantity::kCurrentGain), 1.0 / 1.2, 0.02);
  EXPECT_NEAR(change("biceps_brachii", Quantity::kResistance), 0.2, 0.01);
  EXPECT_NEAR(change("teres_major", Quantity::kFriction), 0.001 / motor.torque_constant,
              0.1 * 0.001 / motor.torque_constant);
  // In series: 1/k = 1/k_before + compliance l_T0.
  const double softer = 1.0 / value_of(changed, "anterior_deltoid", Quantity::kStiffness) -
                        1.0 / value_of(healthy(), "anterior_deltoid", Quantity::kStiffness);
  EXPECT_NEAR(softer, 3e-4 * 0.2452, 0.15 * 3e-4 * 0.2452);
  EXPECT_GT(change("infraspinatus", Quantity::kCreep), 0.02);
  EXPECT_NEAR(ratio("lateral_deltoid", Quantity::kStiffness), 1.0, 0.03);
}

TEST(TendonFigures, SayWhatWasNotMeasured) {
  Dataset test = tested({});
  for (Table& table : test.tables) {
    table.columns.erase(
        std::remove_if(table.columns.begin(), table.columns.end(),
                       [](const Column& c) { return c.name == "brachialis/force"; }),
        table.columns.end());
  }
  const auto figures = measure(arm_protocol(), test);
  EXPECT_EQ(figure_of(figures, "brachialis", Quantity::kStiffness), nullptr);
  EXPECT_NE(figure_of(figures, "brachialis", Quantity::kResistance), nullptr);
  EXPECT_FALSE(figures.back().remarks.empty());
  for (Table& table : test.tables) {
    const std::size_t half = table.t.size() / 2;
    table.t.resize(half);
    for (Column& column : table.columns) column.values.resize(half), column.present.resize(half);
  }
  EXPECT_THROW(measure(arm_protocol(), test), BadInput);
}

}  // namespace
}  // namespace health
}  // namespace anthrob
