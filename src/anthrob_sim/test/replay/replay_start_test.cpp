// Where replays of recordings start.
#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_core/random.h"
#include "anthrob_recording/dataset.h"
#include "anthrob_recording/resolution.h"
#include "anthrob_sim/replay/replay.h"
#include "support.h"

namespace anthrob {
namespace {

using testing_support::config;

std::shared_ptr<const RobotModel> standing_rig() {
  return load_robot_model(config("two_muscle_rig/model_I.yaml"));
}

TEST(ReplayStart, StartsInTheStandThatTheMotorWasMeasuredIn) {
  // Cogging lets it stand in many places beside its reference: here left of it, in the replay's own
  // settling right of it.
  LoadOptions options;
  options.effects = {{"cogging", "flexor", {{"sine", 3e-3}}}};
  const auto model = load_robot_model(config("two_muscle_rig/model_I.yaml"), options);
  Simulation recorded(model);
  recorded.command(0, ecu::Mode::kPosition, 0.5);
  for (int i = 0; i < 1000; ++i) {
    recorded.muscle_inputs().impose_position(0, 0.58, 0.0);
    recorded.step();
  }
  recorded.muscle_inputs().release(0);
  recorded.step(2000);
  const double stand = recorded.reading(0).position;
  constexpr double kCount = 1e-3;
  Dataset recording;
  recording.meta.settle_s = 2.0;
  Table& commands = recording.table("commands");
  commands.t = {0};
  commands.columns = {{"flexor/reference", {0.5}, {1}}};
  Table& muscles = recording.table("muscles");
  Column position{"flexor/position", {}, {}};
  for (int i = 0; i < 300; ++i) {
    muscles.t.push_back(Nanoseconds{1000000} * i);
    position.values.push_back(kCount * std::round(recorded.reading(0).position / kCount));
    position.present.push_back(1);
    if (i > 200) position.values.back() += kCount * (i % 7);  // so that counts are seen
    recorded.step();
  }
  muscles.columns = {position};
  Simulation sim(model);
  const auto starts_at = [&](const Dataset& measured) {
    Replay(model, measured, ReplayMode::kReference).start(sim);
    return sim.reading(0).position;
  };
  Dataset other = recording;
  other.table("muscles").columns.clear();
  const double alone = starts_at(other);
  ASSERT_GT(std::abs(alone - stand), 5.0 * kCount);
  const double began = sim.time();
  EXPECT_NEAR(starts_at(recording), stand, 1.6 * kCount);
  EXPECT_NEAR(sim.time() - began, 2.0, 1e-9);  // in the time that it has to settle
  sim.step(500);                               // and there it stays
  EXPECT_NEAR(sim.reading(0).position, stand, 1.6 * kCount);
  // Where it stands within noise nothing is done; nor where it was measured too late, or so far off
  // that no friction holds it there; nor where meta.yaml says where it began.
  other = recording;
  Column& column = other.table("muscles").columns[0];
  const CounterRandom random(4, 2);
  const auto measure = [&](double at, double noise) {
    for (std::size_t i = 0; i < column.values.size(); ++i) {
      column.values[i] = at + noise * random.normal(i);
    }
  };
  const double off = 0.02;
  measure(alone + off, 0.05);
  ASSERT_EQ(resolution_of(column.values), 0.0);
  ASSERT_GT(std::abs(column.values[0] - alone), 0.01);
  ASSERT_LT(std::abs(column.values[0] - alone), 0.1);
  EXPECT_EQ(starts_at(other), alone);
  measure(alone + off, 1e-4);
  EXPECT_NEAR(starts_at(other), alone + off, 1e-3);
  measure(alone + 2.0, 1e-4);
  EXPECT_EQ(starts_at(other), alone);
  measure(alone + off, 1e-4);
  for (Nanoseconds& t : other.table("muscles").t) t += 200000000;
  EXPECT_EQ(starts_at(other), alone);
  other = recording;
  other.meta.settle_s = 0.3;  // it may be on its way still
  const double led = starts_at(other);
  other.table("muscles").columns.clear();
  EXPECT_EQ(led, starts_at(other));
  recording.meta.start = "zero";
  starts_at(recording);
  const double zero = sim.reading(0).position;
  recording.table("muscles").columns.clear();
  EXPECT_EQ(starts_at(recording), zero);
}

TEST(ReplayStart, StartsWithoutAJerkThatASpringRemembers) {
  LoadOptions options;
  options.effects = {{"see_mullins", "flexor", {{"softening", 0.5}}}};
  const auto model = load_robot_model(config("two_muscle_rig/model_I.yaml"), options);
  Simulation slow(model);
  const auto wind = [&](double from, double to, double time) {
    const int steps = static_cast<int>(std::lround(time / slow.step_length()));
    for (int i = 0; i < steps; ++i) {
      const double speed = (to - from) / time;
      slow.muscle_inputs().impose_position(0, from + (to - from) * (i + 1) / steps, speed);
      slow.muscle_inputs().impose_position(1, -from - (to - from) * (i + 1) / steps, -speed);
      slow.step();
    }
  };
  wind(0.0, 3.0, 1.2);
  wind(3.0, 3.0, 4.8);
  Dataset recording;
  recording.meta.settle_s = 6.0;
  Table& muscles = recording.table("muscles");
  muscles.t = {0, 100000000};
  muscles.columns.push_back({"flexor/position", {3.0, 3.0}, {1, 1}});
  muscles.columns.push_back({"extensor/position", {-3.0, -3.0}, {1, 1}});
  const Dataset replayed = replay(model, recording, ReplayMode::kPosition);
  const double force = slow.reading(0).force;
  EXPECT_GT(force, 1.0);
  EXPECT_NEAR(replayed.find_table("muscles")->find("flexor/force")->values[0], force, 1e-3 * force);
}

/// A second in which nothing moves, away from rest, with so long to settle [s].
Dataset still(double settle) {
  Dataset recording;
  recording.meta.settle_s = settle;
  Table& table = recording.table("muscles");
  table.t = {0, 1000000000};
  table.columns = {{"flexor/position", {1.2, 1.2}, {1, 1}},
                   {"extensor/position", {1.0, 1.0}, {1, 1}},
                   {"hinge/position", {0.1, 0.1}, {1, 1}}};
  return recording;
}

TEST(ReplayStart, BeginsWhereItWasRecordedHoweverShortTheTimeToSettle) {
  for (const double settle : {0.0, 0.05, 8.0}) {
    const Dataset replayed = replay(standing_rig(), still(settle), ReplayMode::kPosture);
    const Table& muscles = *replayed.find_table("muscles");
    for (const char* column : {"flexor/position", "extensor/position", "hinge/position"}) {
      const auto& values = muscles.find(column)->values;
      EXPECT_NEAR(values[0], still(0.0).series(column).values[0], 1e-9) << settle << column;
      EXPECT_NEAR(values[1], values[0], 1e-9);
    }
    const auto& force = replayed.find_table("muscles")->find("flexor/force")->values;
    EXPECT_GT(force[0], 1.0) << settle;
    // Springs are relaxed where there was no time to go there, and nearly so after a long rest.
    EXPECT_NEAR(force[1], force[0], 0.01 * force[0]) << settle;
  }
}

TEST(ReplayStart, PlacesMotorsThatThereIsNoTimeToWind) {
  Dataset recording = still(0.0);
  Table& measured = recording.table("muscles");
  measured.columns = {{"flexor/position", {2.0, 2.0}, {1, 1}},
                      {"extensor/position", {2.0, 2.0}, {1, 1}}};
  for (const double settle : {0.0, 0.001, 0.1}) {
    recording.meta.settle_s = settle;
    const Replay input(standing_rig(), recording, ReplayMode::kPosition);
    Simulation sim(standing_rig());
    input.start(sim);
    EXPECT_NEAR(sim.reading(0).position, 2.0, 1e-12) << settle;
    const double force = sim.muscle(0).spring_tension();
    EXPECT_GT(force, 1.0);
    Replay::Run run(input, sim);
    run.drive(0.0);
    sim.step();
    // Springs are relaxed: no jerk that they would remember.
    EXPECT_NEAR(sim.muscle(0).spring_tension(), force, 0.02 * force) << settle;
    EXPECT_NEAR(sim.reading(0).velocity, 0.0, 1e-9);
  }
}

TEST(ReplayStart, PlacesMusclesWithoutControllersWhereTheyWereMeasured) {
  const auto hill = load_robot_model(config("two_muscle_rig/model_hill.yaml"));
  Dataset recording;
  recording.meta.settle_s = 1.0;
  Table& measured = recording.table("muscles");
  measured.t = {0, 1000000000};
  measured.columns = {{"flexor/position", {0.004, 0.004}, {1, 1}},
                      {"extensor/position", {0.004, 0.004}, {1, 1}}};
  const Replay input(hill, recording, ReplayMode::kPosition);
  Simulation sim(hill);
  input.start(sim);
  EXPECT_NEAR(sim.reading(0).position, 0.004, 1e-12);
  const double force = sim.muscle(0).spring_tension();
  EXPECT_GT(force, 1.0);
  Replay::Run run(input, sim);
  run.drive(0.0);
  sim.step();
  EXPECT_NEAR(sim.muscle(0).spring_tension(), force, 0.02 * force);
  EXPECT_NEAR(sim.reading(0).velocity, 0.0, 1e-9);
}

TEST(ReplayStart, PlacesThePostureThatTheCamerasReadAsMeasured) {
  LoadOptions options;
  options.effects = {{"mocap_misalignment", "x", {{"angle", 0.03}}}};
  const auto model = load_robot_model(config("anthrob/model_I.yaml"), options);
  Dataset recording;
  Table& joints = recording.table("joints");
  joints.t = {0, 1000000000};
  joints.columns = {{"elbow/position", {0.2, 0.2}, {1, 1}},
                    {"shoulder/w", {1.0, 1.0}, {1, 1}},
                    {"shoulder/x", {0.0, 0.0}, {1, 1}},
                    {"shoulder/y", {0.0, 0.0}, {1, 1}},
                    {"shoulder/z", {0.0, 0.0}, {1, 1}}};
  Table& muscles = recording.table("muscles");
  muscles.t = {0, 1000000000};
  muscles.columns = {{"brachialis/position", {0.0, 0.0}, {1, 1}}};
  const int shoulder = model->skeleton->find_joint("shoulder");
  for (const double settle : {0.0, 5.0}) {
    recording.meta.settle_s = settle;
    const Replay input(model, recording, ReplayMode::kPosture);
    Simulation sim(model);
    input.start(sim);
    Replay::Run run(input, sim);
    run.drive(0.0);
    sim.step();
    EXPECT_NEAR(sim.read_ball_velocity(shoulder).norm(), 0.0, 1e-9) << settle;
  }
}

TEST(ReplayStart, MotorsWhosePositionsAreImposedHaveNoCurrent) {
  const Dataset replayed = replay(standing_rig(), still(0.5), ReplayMode::kPosition);
  const Table& muscles = *replayed.find_table("muscles");
  for (const char* column : {"flexor/current", "extensor/voltage"}) {
    EXPECT_EQ(muscles.find(column)->present, std::vector<char>({0, 0})) << column;
  }
  EXPECT_EQ(muscles.find("flexor/force")->present, std::vector<char>({1, 1}));
}

TEST(ReplayStart, BallJointsWithoutMusclesStandAsTheyWereMeasured) {
  auto bare = std::make_shared<RobotModel>(*load_robot_model(config("anthrob/model_I.yaml")));
  bare->muscles.clear();
  auto skeleton = std::make_shared<SkeletonModel>(*bare->skeleton);
  for (JointModel& joint : skeleton->joints) joint.driven = joint.name == "elbow";
  bare->skeleton = skeleton;
  Dataset recording;
  Table& table = recording.table("joints");
  table.t = {0, 5000000};
  const double turn[] = {0.8, 0.6, 0.0, 0.0};
  table.columns = {{"elbow/position", {0.7, 0.7}, {1, 1}}, {"elbow/effort", {0.0, 0.0}, {1, 1}}};
  for (int k = 0; k < 4; ++k) {
    table.columns.push_back({std::string("shoulder/") + "wxyz" [k], { turn[k], turn[k] }, {1, 1}});
  }
  const Replay replay(bare, recording, ReplayMode::kReference);
  Simulation sim(bare);
  replay.start(sim);
  const std::vector<double> expected = {0.8, 0.6, 0.0, 0.0, 0.7};
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_NEAR(sim.configuration()[k], expected[k], 1e-12) << k;
  }
  // What comes later drives nothing.
  Dataset interrupted = recording;
  interrupted.table("joints").columns[3].values.back() = NAN;
  EXPECT_NO_THROW(Replay(bare, interrupted, ReplayMode::kReference));
  // Recordings that begin elsewhere do not share the beginning.
  Dataset other = recording;
  other.table("joints").columns[2].values = {0.6, 0.6};
  other.table("joints").columns[3].values = {0.8, 0.8};
  EXPECT_NE(Replay(bare, other, ReplayMode::kReference).start_inputs(), replay.start_inputs());
}

TEST(ReplayStart, StartsMusclesWithoutControllersAtRest) {
  const auto hill = load_robot_model(config("two_muscle_rig/model_hill.yaml"));
  Dataset recording;
  Table& table = recording.table("commands");
  table.t = {0, 100000000};
  Column& column = table.column("flexor/reference");
  column.values = {0.1, 0.1};  // excitations
  column.present = {1, 1};
  for (const char* start : {"zero", "first"}) {
    recording.meta.start = start;
    recording.meta.settle_s = 0.5;
    const Dataset out = replay(hill, recording, ReplayMode::kReference);
    EXPECT_GT(out.series("flexor/force").values.back(), 1.0) << start;
  }
  recording.meta.start = "given";
  recording.meta.start_position = {{"flexor", 1.0}};
  EXPECT_THROW(replay(hill, recording, ReplayMode::kReference), BadInput);
  recording.meta.start_position = {{"flexro", 1.0}};
  EXPECT_THROW(replay(standing_rig(), recording, ReplayMode::kReference), BadInput);
}

}  // namespace
}  // namespace anthrob
