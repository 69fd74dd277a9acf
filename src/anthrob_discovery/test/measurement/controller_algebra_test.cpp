// Recorded references and measurements give the recorded voltages, or tell who is stamped late.
#include "measurement/controller_algebra.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "anthrob_core/random.h"
#include "config.h"

namespace anthrob {
namespace discovery {
namespace {

constexpr double kTick = 0.001;  // [s]

/// The rig's flexor, made up: what it measures obeys no physics, only its control law.
struct Conventions {
  double voltage_late = 0.0, position_late = 0.0, force_late = 0.0;  ///< stamps [s]
  double seen_late = 0.0;         ///< until the controller gets measurements [s]
  double other_derivative = 1.0;  ///< gain of the robot over that of the model
  bool after_tick = false;        ///< voltages, not before it
  double camera = 0.0;            ///< period of positions and velocities, if not that of rows [s]
};

std::shared_ptr<const RobotModel> rig() {
  static const auto robot = load_robot_model(kConfig + "/two_muscle_rig/model_I.yaml");
  return robot;
}

double position(double t) {
  return std::sin(2.0 * t) + 0.3 * std::sin(7.1 * t);
}
double velocity(double t) {
  return 2.0 * std::cos(2.0 * t) + 2.13 * std::cos(7.1 * t);
}
double force(double t) {
  return 30.0 + 20.0 * std::sin(3.3 * t + 1.0);
}
/// A new one every 10 ms.
double reference(double t) {
  const double command = 0.01 * std::floor(100.0 * t + 1e-6);
  return position(command) + 0.2 * std::sin(11.0 * command);
}

/// As many as it takes.
ControllerAlgebraOptions few_rows() {
  ControllerAlgebraOptions options;
  options.most_rows = 4000;
  return options;
}

Dataset record(const Conventions& how) {
  const ecu::PositionGains gains = rig()->muscles[0].controller.position;
  const CounterRandom random(7, 1);
  std::uint64_t index = 0;
  Dataset data;
  data.folder = "run";
  Table& commands = data.table("commands");
  Column& asked = commands.column("flexor/reference");
  for (int i = 0; i < 1000; ++i) {
    commands.t.push_back(static_cast<Nanoseconds>(i) * 10000000);
    asked.values.push_back(reference(0.01 * i)), asked.present.push_back(1);
  }
  Table& muscles = data.table("muscles");
  for (const char* quantity : {"position", "velocity", "force", "voltage"}) {
    muscles.column(std::string("flexor/") + quantity);
  }
  for (int i = 0; i < 2000; ++i) {
    const double t = 0.005 * i;
    const auto noise = [&](double size) { return size * random.normal(index++); };
    const double tick = t - how.voltage_late - (how.after_tick ? 0.0 : kTick),
                 seen = tick - how.seen_late;
    const double voltage =
        gains.proportional * (reference(tick) - position(seen) - noise(1e-3)) -
        how.other_derivative * gains.derivative * (velocity(seen) + noise(0.02)) +
        gains.force_feedforward * (force(seen) + noise(0.1));
    muscles.t.push_back(static_cast<Nanoseconds>(i) * 5000000);
    const double values[] = {position(t - how.position_late) + noise(1e-3),
                             velocity(t - how.position_late) + noise(0.02),
                             force(t - how.force_late) + noise(0.1), voltage};
    for (std::size_t k = 0; k < 4; ++k) {
      muscles.columns[k].values.push_back(values[k]), muscles.columns[k].present.push_back(1);
    }
  }
  return data;
}

/// What is measured of positions only so often, anywhere between rows.
void take_positions(Dataset& data, double period) {
  Table seen;
  seen.name = "positions";
  seen.column("flexor/position"), seen.column("flexor/velocity");
  for (double t = 0.0013; t < 9.99; t += period) {
    seen.t.push_back(static_cast<Nanoseconds>(std::llround(1e9 * t)));
    for (Column& column : seen.columns) {
      column.values.push_back(column.quantity() == "position" ? position(t) : velocity(t));
      column.present.push_back(1);
    }
  }
  Table& muscles = data.table("muscles");
  muscles.columns.erase(muscles.columns.begin(), muscles.columns.begin() + 2);
  data.tables.push_back(seen);
}

std::optional<StampShift> shift_in(const Conventions& how) {
  Dataset recording = record(how);
  if (how.camera > 0.0) take_positions(recording, how.camera);
  const ControllerAlgebra algebra(*rig(), {&recording}, few_rows());
  EXPECT_TRUE(algebra.is_known());
  return algebra.stamp_shift();
}

void expect_shift(const Conventions& how, LateStamp what, double late) {
  const auto shift = shift_in(how);
  ASSERT_TRUE(shift);
  EXPECT_EQ(shift->what, what);
  EXPECT_NEAR(shift->late, late, 0.6 * kTick);
  EXPECT_LT(shift->sigma, kTick);
}

TEST(ControllerAlgebra, NothingIsFoundInWhatTheModelsSensorsWrite) {
  EXPECT_FALSE(shift_in({}));
}

TEST(ControllerAlgebra, VoltagesAfterTheTickAreOneTickEarly) {
  Conventions how;
  how.after_tick = true;
  expect_shift(how, LateStamp::kVoltage, -kTick);
}

TEST(ControllerAlgebra, PositionsThatAreSeldomMeasuredMakeNoShift) {
  Conventions how;
  how.camera = 0.0547;
  EXPECT_FALSE(shift_in(how));
  how.after_tick = true;
  expect_shift(how, LateStamp::kVoltage, -kTick);
}

TEST(ControllerAlgebra, LateVoltagesAreFoundAlsoBetweenRowsAndTicks) {
  for (const double late : {0.005, 0.0065, 0.0154}) {
    Conventions how;
    how.voltage_late = late;
    expect_shift(how, LateStamp::kVoltage, late);
  }
}

TEST(ControllerAlgebra, LatePositionsAreWhatTheControllerKnewBefore) {
  Conventions how;
  how.position_late = 0.006;
  expect_shift(how, LateStamp::kPosition, 0.006);
}

TEST(ControllerAlgebra, LateForcesAreFoundByTheirFeedForward) {
  Conventions how;
  how.force_late = 0.012;
  expect_shift(how, LateStamp::kForce, 0.012);
}

TEST(ControllerAlgebra, AControllerThatSeesLateIsNoMatterOfStamps) {
  Conventions how;
  how.seen_late = 0.008;
  EXPECT_FALSE(shift_in(how));
}

TEST(ControllerAlgebra, AnotherGainIsNoMatterOfStamps) {
  Conventions how;
  how.other_derivative = 1.2;
  EXPECT_FALSE(shift_in(how));
  const Dataset other = record(how), right = record({});
  EXPECT_GT(ControllerAlgebra(*rig(), {&other}, few_rows()).left({}),
            2.0 * ControllerAlgebra(*rig(), {&right}, few_rows()).left({}));
}

TEST(ControllerAlgebra, ARecordingOfAnotherMakeIsLeftAlone) {
  Conventions how;
  how.after_tick = true;
  const Dataset one = record(how), two = record(how), other = record({});
  const ControllerAlgebra algebra(*rig(), {&one, &two, &other}, few_rows());
  EXPECT_FALSE(algebra.stamp_shift());
  const auto shift = ControllerAlgebra(*rig(), {&one, &two}, few_rows()).stamp_shift();
  ASSERT_TRUE(shift);
  EXPECT_EQ(shift->what, LateStamp::kVoltage);
  EXPECT_TRUE(algebra.helps(*shift, 0));
  EXPECT_TRUE(algebra.helps(*shift, 1));
  EXPECT_FALSE(algebra.helps(*shift, 2));
}

TEST(ControllerAlgebra, WithoutReferencesNothingIsKnown) {
  Dataset data = record({});
  data.tables.erase(data.tables.begin());
  EXPECT_FALSE(ControllerAlgebra(*rig(), {&data}, few_rows()).is_known());
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
