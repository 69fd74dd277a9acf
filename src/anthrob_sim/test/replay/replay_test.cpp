// Recordings replayed.
#include "anthrob_sim/replay/replay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/core/errors.h"
#include "support.h"

namespace anthrob {
namespace {

using testing_support::config;

std::shared_ptr<const RobotModel> rig(double step = 1e-3) {
  return load_robot_model(config("two_muscle_rig/model_I.yaml"), {step, {}});
}

TEST(Replay, ReproducesTheSimulationThatWasRecorded) {
  // Record a run at its steps, replay its references: the same numbers.
  Dataset recording;
  recording.meta.settle_s = 1.0;
  Table& commands = recording.table("commands");
  for (const double t : {0.0, 0.4, 1.1}) commands.t.push_back(std::llround(t * 1e9));
  Column& flexor = commands.column("flexor/reference");
  flexor.values = {0.5, 3.0, 1.0};
  flexor.present = {1, 1, 1};
  Simulation sim(rig());
  sim.command(0, ecu::Mode::kPosition, 0.5);
  sim.step(1000);
  Table& joints = recording.table("joints");
  std::vector<double> angles, forces;
  for (int i = 0; i <= 2000; ++i) {
    joints.t.push_back(Nanoseconds{1000000} * i);
    angles.push_back(sim.configuration()[0]);
    if (i == 400) sim.command(0, ecu::Mode::kPosition, 3.0);
    if (i == 1100) sim.command(0, ecu::Mode::kPosition, 1.0);
    sim.step();
  }
  joints.columns.push_back({"hinge/position", angles, std::vector<char>(angles.size(), 1)});

  const Dataset replayed = replay(rig(), recording, ReplayMode::kReference);
  EXPECT_EQ(replayed.find_table("joints")->find("hinge/position")->values, angles);
  // What no file had is added; commands are copied.
  EXPECT_NE(replayed.find_table("muscles")->find("extensor/force"), nullptr);
  EXPECT_NE(replayed.find_table("joints")->find("hinge/velocity"), nullptr);
  EXPECT_EQ(replayed.find_table("commands")->find("flexor/reference")->values, flexor.values);
  EXPECT_EQ(replayed.find_table("muscles")->t, joints.t);
}

/// 3 s in which the hinge is loaded from the second on, with rows in every 10 ms.
Dataset loaded(double load) {
  Dataset recording;
  recording.meta.settle_s = 0.1;
  Table& commands = recording.table("commands");
  commands.t = {0};
  commands.columns.push_back({"flexor/reference", {0.5}, {1}});
  Table& joints = recording.table("joints");
  Column position{"hinge/position", {}, {}}, applied{"hinge/load", {}, {}};
  for (int i = 0; i <= 300; ++i) {
    joints.t.push_back(Nanoseconds{10000000} * i);
    position.values.push_back(0.0);
    applied.values.push_back(i >= 200 ? load : 0.0);
  }
  position.present = applied.present = std::vector<char>(301, 1);
  joints.columns = {position, applied};
  return recording;
}

TEST(Replay, NothingActsBeforeItsFirstRow) {
  const Dataset said = loaded(0.1);
  Dataset unsaid = said;
  Column& load = *unsaid.table("joints").columns.rbegin();
  std::fill_n(load.present.begin(), 200, char{0});
  std::fill_n(load.values.begin(), 200, 0.0);
  const auto angles = [](const Dataset& recording) {
    const Dataset replayed = replay(rig(), recording, ReplayMode::kReference);
    return replayed.find_table("joints")->find("hinge/position")->values;
  };
  EXPECT_EQ(angles(unsaid), angles(said));
}

TEST(Replay, SettlesUnderTheLoadThatActsAtFirst) {
  Dataset recording = loaded(0.1);
  recording.meta.settle_s = 12.0;
  auto& load = recording.table("joints").columns.back().values;
  std::fill(load.begin(), load.end(), 0.1);
  const Dataset replayed = replay(rig(), recording, ReplayMode::kReference);
  const auto& angle = replayed.find_table("joints")->find("hinge/position")->values;
  const Dataset other = replay(rig(), loaded(0.0), ReplayMode::kReference);
  const double unloaded = other.find_table("joints")->find("hinge/position")->values.back();
  ASSERT_GT(std::abs(angle.back() - unloaded), 0.02);
  // But for what creeps through the hinge's friction it stands where it will.
  EXPECT_LT(std::abs(angle.back() - angle.front()), 0.1 * std::abs(angle.back() - unloaded));
  // What the last recording ended with is not the next one's.
  Simulation sim(rig());
  sim.apply_load(0, 0.1);
  Replay(rig(), loaded(0.0), ReplayMode::kReference).start(sim);
  EXPECT_EQ(sim.joint_load(0), 0.0);
  EXPECT_NE(Replay(rig(), recording, ReplayMode::kReference).start_inputs(),
            Replay(rig(), loaded(0.1), ReplayMode::kReference).start_inputs());
}

TEST(Replay, OneThatIsStoppedHasTheRowsUntilThen) {
  const Dataset recording = loaded(0.1);
  const Dataset whole = replay(rig(), recording, ReplayMode::kReference);
  EXPECT_EQ(whole.meta.other.count("cut_short"), 0u);
  int asked = 0;  // after 0, 1 and 2 s
  const Dataset part =
      replay(rig(), recording, ReplayMode::kReference, [&](double) { return ++asked < 3; });
  const Table& joints = *part.find_table("joints");
  ASSERT_EQ(joints.t.size(), 201u);
  const std::vector<double>& all = whole.find_table("joints")->find("hinge/position")->values;
  EXPECT_EQ(joints.find("hinge/position")->values,
            std::vector<double>(all.begin(), all.begin() + 201));
  EXPECT_EQ(part.meta.other.at("cut_short"), "at 2.001 s of 3 s\n");
  EXPECT_EQ(replay(rig(), part, ReplayMode::kReference).meta.other.count("cut_short"), 0u);
}

TEST(Replay, OneThatIsStoppedWhileTheRobotSettlesHasNoRows) {
  Dataset recording = loaded(0.1);
  recording.meta.settle_s = 30.0;
  recording.table("muscles").t = {0};
  recording.table("muscles").columns = {{"flexor/position", {0.5}, {1}},
                                        {"extensor/position", {0.5}, {1}}};
  for (const ReplayMode mode :
       {ReplayMode::kReference, ReplayMode::kPosition, ReplayMode::kPosture}) {
    int asked = 0;
    const Dataset part = replay(rig(), recording, mode, [&](double share) {
      EXPECT_EQ(share, 0.0);
      return ++asked < 3;
    });
    EXPECT_EQ(asked, 3);
    EXPECT_EQ(part.meta.other.at("cut_short"), "at 0 s of 3 s\n");
    for (const Table& table : part.tables) EXPECT_TRUE(table.t.empty()) << table.name;
  }
}

TEST(Replay, OneThatFailsHasTheRowsUntilThen) {
  const Dataset recording = loaded(1e200);
  EXPECT_THROW(replay(rig(), recording, ReplayMode::kReference), NumericalFailure);
  std::string failure;
  const Dataset part = replay(rig(), recording, ReplayMode::kReference, {}, &failure);
  EXPECT_NE(failure.find("numerical failure"), std::string::npos) << failure;
  EXPECT_EQ(part.find_table("joints")->t.size(), 201u);
  EXPECT_EQ(part.meta.other.count("cut_short"), 1u);
}

/// A robot's node in short: takes or refuses commands for the rig's flexor, records what it is told
/// and what it says of itself.
class Session {
 public:
  Session() : sim_(rig()) {
    recording.meta.settle_s = 1.0;
    recording.table("commands");
    recording.table("muscles");
  }
  Simulation& sim() { return sim_; }

  void command(ecu::Mode mode, double reference) {
    miss(mode, reference);
    if (sim_.muscle(0).enabled() && reference <= 30.0) sim_.command(0, mode, reference);
  }
  /// A command that is recorded only.
  void miss(ecu::Mode mode, double reference) {
    Table& commands = recording.table("commands");
    commands.t.push_back(now_);
    add(commands, "flexor/mode", static_cast<double>(mode));
    add(commands, "flexor/reference", reference);
  }
  void enable(bool enabled) {
    if (!enabled) sim_.command(0, ecu::Mode::kVoltage, 0.0);
    sim_.muscle_inputs().set_enabled(0, enabled);
  }
  void run(double time) {
    for (const auto end = now_ + std::llround(time * 1e9); now_ < end; now_ += 1000000) {
      Table& muscles = recording.table("muscles");
      muscles.t.push_back(now_);
      const Muscle& flexor = sim_.muscle(0);
      add(muscles, "flexor/position", flexor.actuator().position);
      add(muscles, "flexor/mode", static_cast<double>(flexor.mode()));
      add(muscles, "flexor/reference", flexor.reference());
      add(muscles, "flexor/ecu_state", flexor.enabled() ? 2.0 : 3.0);
      add(muscles, "flexor/voltage", flexor.voltage());
      sim_.step();
    }
  }
  /// Largest difference of a replay from what the motor did [rad].
  double replay_error() const {
    const Dataset replayed = replay(rig(), recording, ReplayMode::kReference);
    const auto& is = replayed.find_table("muscles")->find("flexor/position")->values;
    const auto& was = recording.find_table("muscles")->find("flexor/position")->values;
    double most = 0.0;
    for (std::size_t i = 0; i < is.size(); ++i) most = std::max(most, std::abs(is[i] - was[i]));
    return most;
  }

  Dataset recording;

 private:
  static void add(Table& table, const std::string& name, double value) {
    Column& column = table.column(name);
    column.values.resize(table.t.size()), column.present.resize(table.t.size());
    column.values.back() = value, column.present.back() = 1;
  }

  Simulation sim_;
  Nanoseconds now_ = 0;
};

TEST(Replay, StartsWhereARobotStandsThatNobodyCommandsYet) {
  Session session;
  for (int i = 0; i < 2000; ++i) {  // Left somewhere, before the recording begins.
    session.sim().muscle_inputs().impose_position(0, 2.0, 0.0);
    session.sim().step();
  }
  session.sim().muscle_inputs().release(0);
  session.run(0.3);
  session.command(ecu::Mode::kPosition, 5.0);
  session.run(0.7);
  EXPECT_LT(session.replay_error(), 0.05);
}

TEST(Replay, StopsWhereItsUnitWasStopped) {
  Session session;
  session.command(ecu::Mode::kPosition, 0.0);
  session.run(0.2);
  session.command(ecu::Mode::kPosition, 4.0);
  session.run(0.05);  // under way
  session.enable(false);
  session.run(0.3);
  session.command(ecu::Mode::kPosition, 6.0);  // not heard
  session.run(0.3);
  session.enable(true);
  session.run(0.3);
  session.command(ecu::Mode::kPosition, 1.0);
  session.run(0.4);
  EXPECT_LT(session.replay_error(), 0.05);
  const Dataset replayed = replay(rig(), session.recording, ReplayMode::kReference);
  const auto& is = replayed.find_table("muscles")->find("flexor/ecu_state")->values;
  EXPECT_EQ(is[300], 3.0);
  EXPECT_EQ(is.back(), 2.0);
}

TEST(Replay, LeavesOutCommandsThatWereRefused) {
  Session session;
  session.command(ecu::Mode::kPosition, 0.0);
  session.run(0.3);
  for (int i = 0; i < 5; ++i) {
    session.command(ecu::Mode::kPosition, 60.0);
    session.run(0.1);
  }
  for (int i = 1; i <= 50; ++i) {  // faster than a state could show each
    session.command(ecu::Mode::kPosition, 0.02 * i);
    session.run(0.01);
  }
  EXPECT_LT(session.replay_error(), 0.02);
}

/// As rosbag records commands that begin while it connects.
void record_without_the_first(Session& session, double missing) {
  session.run(0.3);
  session.sim().command(0, ecu::Mode::kPosition, 3.0);
  session.run(missing);
  for (int i = 0; i < 5; ++i) {
    session.command(ecu::Mode::kPosition, 3.0);
    session.run(0.1);
  }
}

TEST(Replay, BeginsARepeatedCommandWhereItsUnitDid) {
  for (const double missing : {0.2, 0.7}) {
    Session session;
    record_without_the_first(session, missing);
    EXPECT_LT(session.replay_error(), 0.02) << missing;
  }
}

/// As rosbag records commands that begin while the unit connects.
TEST(Replay, LeavesOutTheFirstOfARepeatedCommandThatItsUnitMissed) {
  Session session;
  session.command(ecu::Mode::kPosition, 1.0);
  session.run(0.3);
  for (int i = 0; i < 2; ++i) {
    session.miss(ecu::Mode::kPosition, 3.0);
    session.run(0.1);
  }
  for (int i = 0; i < 5; ++i) {
    session.command(ecu::Mode::kPosition, 3.0);
    session.run(0.1);
  }
  EXPECT_LT(session.replay_error(), 0.02);
}

TEST(Replay, RefusesWhatNobodyCommanded) {
  Session session;
  session.command(ecu::Mode::kPosition, 1.0);
  session.run(0.3);
  session.sim().command(0, ecu::Mode::kForce, 5.0);  // past the topic, as homing does
  session.run(0.3);
  try {
    session.replay_error();
    FAIL();
  } catch (const BadInput& e) {
    EXPECT_NE(std::string(e.what()).find("flexor: at 0.3"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("followed FORCE 5"), std::string::npos) << e.what();
  }
  // As the message advises.
  EXPECT_NO_THROW(replay(rig(), session.recording, ReplayMode::kVoltage));
}

TEST(Replay, ImposedPositionsAreFollowedExactly) {
  Dataset recording;
  Table& muscles = recording.table("muscles");
  Column flexor{"flexor/position", {}, {}};
  for (int i = 0; i <= 200; ++i) {
    muscles.t.push_back(Nanoseconds{5000000} * i);
    flexor.values.push_back(0.3 * std::sin(0.05 * i));
    flexor.present.push_back(1);
  }
  muscles.columns.push_back(flexor);
  const Dataset replayed = replay(rig(), recording, ReplayMode::kPosition);
  const auto& values = replayed.find_table("muscles")->find("flexor/position")->values;
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], flexor.values[i], 1e-12);
}

/// What a rig with effects records at every step: position, voltage and force of both muscles, and
/// the posture.
Dataset recording_of(const std::shared_ptr<const RobotModel>& model) {
  Dataset recording;
  recording.meta.start = "zero";
  recording.meta.settle_s = 0.0;
  Table& table = recording.table("muscles");
  const std::vector<std::string> quantities = {"position", "voltage", "force"};
  for (const MuscleModel& muscle : model->muscles) {
    for (const auto& quantity : quantities) {
      table.columns.push_back({muscle.name + "/" + quantity, {}, {}});
    }
  }
  table.columns.push_back({"hinge/position", {}, {}});
  Simulation sim(model);
  for (int i = 0; i <= 1500; ++i) {
    table.t.push_back(Nanoseconds{1000000} * i);
    table.columns.back().values.push_back(sim.read_positions()[0]);
    table.columns.back().present.push_back(1);
    std::size_t column = 0;
    for (int m = 0; m < 2; ++m) {
      const ecu::Measurement reading = sim.reading(m);
      for (const double value : {reading.position, sim.muscle(m).voltage(), reading.force}) {
        table.columns[column].values.push_back(value);
        table.columns[column++].present.push_back(1);
      }
    }
    sim.command(0, ecu::Mode::kPosition, 1.5 + std::sin(0.006 * i));
    sim.command(1, ecu::Mode::kPosition, 1.5 - std::sin(0.006 * i));
    sim.step();
  }
  return recording;
}

/// Largest difference of a replay in a quantity of both muscles.
double worst(const std::shared_ptr<const RobotModel>& model, const Dataset& recording,
             ReplayMode mode, const std::string& quantity, std::size_t from = 0) {
  const Dataset replayed = replay(model, recording, mode);
  double worst = 0.0;
  for (const MuscleModel& muscle : model->muscles) {
    const auto& was = recording.find_table("muscles")->find(muscle.name + "/" + quantity)->values;
    const auto& is = replayed.find_table("muscles")->find(muscle.name + "/" + quantity)->values;
    for (std::size_t i = from; i < was.size(); ++i) {
      const double difference = std::abs(is[i] - was[i]);
      if (!(difference <= worst)) worst = difference;
    }
  }
  return worst;
}

std::shared_ptr<const RobotModel> rig_with(const EffectInstance& effect) {
  LoadOptions options;
  options.step = 1e-3;
  options.effects = {effect};
  return load_robot_model(config("two_muscle_rig/model_I.yaml"), options);
}

TEST(Replay, RecordedVoltagesAreNotDelayedAgain) {
  // A recorded voltage acted during the step before its row: that error the plain rig has, too.
  const double plain = worst(rig(), recording_of(rig()), ReplayMode::kVoltage, "position");
  const auto late = rig_with({"command_latency", "all", {{"delay", 0.02}}});
  const double delayed = worst(late, recording_of(late), ReplayMode::kVoltage, "position");
  EXPECT_GT(plain, 0.0);
  EXPECT_LT(delayed, 2.0 * plain);
}

TEST(Replay, ImposedPositionsAreWhatWasReadNotWhatWas) {
  const double force = 20.0;
  EXPECT_LT(worst(rig(), recording_of(rig()), ReplayMode::kPosition, "force"), 1e-9 * force);
  for (const EffectInstance& effect :
       {EffectInstance{"encoder_drift", "all", {{"rate", 0.05}, {"missed", 0.0}}},
        EffectInstance{"encoder_drift", "all", {{"rate", 0.0}, {"missed", 0.1}}}}) {
    const auto robot = rig_with(effect);
    const Dataset recording = recording_of(robot);
    EXPECT_LT(worst(robot, recording, ReplayMode::kPosition, "force"), 1e-6 * force);
    EXPECT_LT(worst(robot, recording, ReplayMode::kPosition, "position"), 1e-9);
  }
  // The last 20 ms were not read any more; readings between two steps are blends of them.
  const auto late = rig_with({"sensing_latency", "all", {{"delay", 0.02}}});
  Dataset recording = recording_of(late);
  EXPECT_LT(worst(late, recording, ReplayMode::kPosition, "force"), 0.01 * force);
}

TEST(Replay, ImposedPosturesCutOffWhatTheJointsDo) {
  const double force = 20.0;
  const Dataset stiff = recording_of(rig_with({"joint_viscous", "hinge", {{"damping", 0.5}}}));
  EXPECT_GT(worst(rig(), stiff, ReplayMode::kPosition, "force"), 0.05 * force);
  EXPECT_LT(worst(rig(), stiff, ReplayMode::kPosture, "force"), 1e-6 * force);
  const Dataset replayed = replay(rig(), stiff, ReplayMode::kPosture);
  const auto& was = stiff.find_table("muscles")->find("hinge/position")->values;
  const auto& is = replayed.find_table("muscles")->find("hinge/position")->values;
  for (std::size_t i = 0; i < was.size(); ++i) ASSERT_NEAR(is[i], was[i], 1e-12) << i;
  // What muscles do stays.
  const Dataset soft = recording_of(rig_with({"tendon_elasticity", "all", {{"compliance", 1e-4}}}));
  EXPECT_GT(worst(rig(), soft, ReplayMode::kPosture, "force"), 0.01 * force);
}

TEST(Replay, ImposedPosturesAreWhatWasReadNotWhatWas) {
  // The last 20 ms were not read any more.
  const double force = 20.0;
  const auto late = rig_with({"mocap_delay", "global", {{"delay", 0.02}}});
  const Dataset recording = recording_of(late);
  EXPECT_GT(worst(rig(), recording, ReplayMode::kPosture, "force"), 0.02 * force);
  EXPECT_LT(worst(late, recording, ReplayMode::kPosture, "force"), 0.01 * force);

  LoadOptions options;
  options.effects = {{"mocap_misalignment", "y", {{"angle", 0.1}}}};
  Simulation sim(load_robot_model(config("anthrob/model_I.yaml"), options));
  const std::vector<double> read = {std::cos(0.2), 0.0, 0.0, std::sin(0.2), 0.7};
  sim.imposed_posture().impose_reading(read);
  sim.step(2);
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(sim.read_positions()[k], read[k], 1e-12) << k;
  const double* is = sim.configuration().data();
  EXPECT_NEAR(
      angular_distance(Quat(is[0], is[1], is[2], is[3]), Quat(read[0], read[1], read[2], read[3])),
      0.1, 1e-9);
}

TEST(Replay, PosturesAreImposedOfAllJointsOrNone) {
  Dataset recording = recording_of(rig());
  recording.tables[0].columns.pop_back();
  EXPECT_THROW(replay(rig(), recording, ReplayMode::kPosture), BadInput);
  recording = recording_of(rig());
  recording.tables[0].columns.back().values[7] = std::nan("");
  EXPECT_THROW(replay(rig(), recording, ReplayMode::kPosture), BadInput);
}

TEST(Replay, AnOrientationIsImposedOnTheShortWayWhateverItsSign) {
  const auto arm = load_robot_model(config("anthrob/model_I.yaml"));
  Dataset recording;
  recording.meta.settle_s = 0.2;
  Table& table = recording.table("spherical_joints");
  table.t = {0, 100000000, 200000000};
  const double c = std::cos(0.1), s = std::sin(0.1);  // 0.2 rad about z
  table.columns = {{"shoulder/w", {1.0, -c, 1.0}, {1, 1, 1}},
                   {"shoulder/x", {0.0, 0.0, 0.0}, {1, 1, 1}},
                   {"shoulder/y", {0.0, 0.0, 0.0}, {1, 1, 1}},
                   {"shoulder/z", {0.0, -s, 0.0}, {1, 1, 1}},
                   {"elbow/position", {0.3, 0.3, 0.3}, {1, 1, 1}}};
  Table& muscles = recording.table("muscles");
  muscles.t = {0};
  for (const MuscleModel& muscle : arm->muscles) {
    muscles.columns.push_back({muscle.name + "/position", {0.0}, {1}});
  }
  const Replay input(arm, recording, ReplayMode::kPosture);
  Simulation sim(arm);
  input.start(sim);
  Replay::Run run(input, sim);
  double widest = 0.0;
  for (int i = 0; i < 200; ++i) {
    run.drive(1e-3 * i);
    sim.step();
    const double* q = sim.configuration().data();
    widest = std::max(widest, 2.0 * std::atan2(std::hypot(q[1], q[2], q[3]), std::abs(q[0])));
  }
  EXPECT_NEAR(widest, 0.2, 1e-6);
  EXPECT_NEAR(sim.configuration()[4], 0.3, 1e-12);
  recording.table("spherical_joints").columns[0].values[1] = 0.0;  // no rotation any more
  EXPECT_THROW(Replay(arm, recording, ReplayMode::kPosture), BadInput);
}

TEST(Replay, RowsBetweenStepsAreInterpolated) {
  Dataset recording;
  recording.meta.settle_s = 0.1;
  Table& muscles = recording.table("muscles");
  Column reference{"flexor/reference", {2.0}, {1}};
  muscles.t.push_back(0);
  for (int i = 1; i < 300; ++i) {
    muscles.t.push_back(Nanoseconds{333333} * i);
    reference.values.push_back(2.0);
    reference.present.push_back(1);
  }
  muscles.columns.push_back(reference);
  Column position{"flexor/position", std::vector<double>(300, 0.0), std::vector<char>(300, 0)};
  muscles.columns.push_back(position);
  recording.meta.start = "zero";
  const auto values = replay(rig(), recording, ReplayMode::kReference)
                          .find_table("muscles")
                          ->find("flexor/position")
                          ->values;
  for (std::size_t i = 2; i < values.size(); ++i) {
    EXPECT_LT(std::abs(values[i] - 2 * values[i - 1] + values[i - 2]), 2e-4);  // no steps
  }
  EXPECT_GT(values.back(), 0.1);
}

TEST(Replay, AnOrientationIsNotBlendedBetweenItsTwoSigns) {
  // A bob on a ball joint falls from 30 degrees above the horizontal and swings through the turn
  // by 180 degrees, where the number w of its orientation would get negative.
  const testing_support::TemporaryRobot robot(R"(<robot name="p"><link name="world"/>
      <joint name="ball" type="floating"><parent link="world"/><child link="bob"/></joint>
      <link name="bob"><inertial><origin xyz="0 0.433 0.25"/><mass value="2"/>
      <inertia ixx="1e-3" ixy="0" ixz="0" iyy="1e-3" iyz="0" izz="1e-3"/></inertial></link>
      <joint name="axis" type="prismatic"><parent link="world"/><child link="carriage"/>
      <axis xyz="1 0 0"/><limit lower="-1" upper="1" effort="0" velocity="0"/></joint>
      <link name="carriage"><inertial><mass value="1"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link></robot>)",
                                              R"(robot: robot.urdf
gravity: [0, 0, -9.81]
joints:
  ball: {type: ball, center: [0, 0, 0]}
  axis: {driven: true, stop: {stiffness: 1000, damping: 1}}
)");
  Dataset recording;
  Table& joints = recording.table("joints");
  joints.columns.push_back({"axis/effort", {}, {}});
  for (int i = 0; i < 6000; ++i) {
    joints.t.push_back(Nanoseconds{333333} * i);
    joints.columns[0].values.push_back(0.0);
    joints.columns[0].present.push_back(1);
  }
  const Dataset replayed = replay(robot.load(), recording, ReplayMode::kReference);
  const Table& balls = *replayed.find_table("spherical_joints");
  const auto turn = [&](std::size_t i) {
    const auto part = [&](const char* name) { return balls.find(name)->values[i]; };
    return Eigen::Vector4d(part("ball/w"), part("ball/x"), part("ball/y"), part("ball/z"));
  };
  int changes = 0;
  for (std::size_t i = 1; i < balls.t.size(); ++i) {
    EXPECT_NEAR(turn(i).norm(), 1.0, 1e-4) << "row " << i;
    changes += turn(i).dot(turn(i - 1)) < 0.0;
  }
  EXPECT_GE(changes, 1);
}

TEST(Replay, RefusesWhatTheRobotLacks) {
  Dataset recording;
  Table& table = recording.table("muscles");
  table.t = {0, 1000000};
  table.column("biceps_brachii/reference");
  EXPECT_THROW(replay(rig(), recording, ReplayMode::kReference), BadInput);
  table.columns.clear();
  table.column("hinge/w");
  EXPECT_THROW(replay(rig(), recording, ReplayMode::kReference), BadInput);
  table.columns.clear();
  table.column("flexor/force");
  EXPECT_THROW(replay(rig(), recording, ReplayMode::kReference), BadInput);  // no input
}

/// One row of a recording of the rig is bad; what a replay says to that, empty if it takes it.
std::string verdict(const std::string& bad, double value, ReplayMode mode,
                    const std::string& without = "") {
  Dataset recording;
  recording.folder = "run";
  recording.meta.settle_s = 0.01;
  Table& table = recording.table("muscles");
  table.t = {0, 1000000, 2000000};
  for (const char* name : {"flexor/reference", "flexor/mode", "flexor/voltage", "flexor/position",
                           "flexor/force", "hinge/position", "hinge/effort", "hinge/load"}) {
    if (name == without) continue;
    Column& column = table.column(name);
    column.values = {0.0, name == bad ? value : 0.0, 0.0};
    if (!without.empty() && name == bad) column.values[0] = value;
    column.present = {1, 1, 1};
  }
  try {
    replay(rig(), recording, mode);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(Replay, RefusesInputsThatAreNotNumbersAndLeavesMeasurementsAlone) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  const ReplayMode reference = ReplayMode::kReference, voltage = ReplayMode::kVoltage,
                   position = ReplayMode::kPosition;
  EXPECT_EQ(verdict("flexor/position", nan, position),
            "run/muscles.csv: row 2: flexor/position: nan: expected a finite number: it drives the "
            "replay");
  EXPECT_EQ(verdict("flexor/mode", 7.0, reference),
            "run/muscles.csv: row 2: flexor/mode: 7: expected VOLTAGE, POSITION, CURRENT or FORCE");
  EXPECT_NE(verdict("flexor/reference", nan, reference), "");
  EXPECT_NE(verdict("flexor/reference", inf, reference), "");
  EXPECT_NE(verdict("flexor/voltage", -inf, voltage), "");
  EXPECT_NE(verdict("hinge/load", nan, position), "");
  // A start without references is at the first positions.
  EXPECT_NE(verdict("flexor/position", nan, voltage, "flexor/reference"), "");

  EXPECT_EQ(verdict("flexor/position", nan, reference), "");
  EXPECT_EQ(verdict("flexor/voltage", nan, reference), "");
  EXPECT_EQ(verdict("flexor/reference", nan, position), "");
  for (const ReplayMode mode : {reference, voltage, position}) {
    EXPECT_EQ(verdict("flexor/force", nan, mode), "");
    EXPECT_EQ(verdict("hinge/position", nan, mode), "");
    EXPECT_EQ(verdict("hinge/effort", nan, mode), "");  // the hinge is not driven
  }
}

TEST(Replay, StopsWhenToldTo) {
  Dataset recording;
  Table& table = recording.table("commands");
  table.t = {0, 10000000000};
  Column& column = table.column("flexor/reference");
  column.values = {1.0, 1.0};
  column.present = {1, 1};
  int calls = 0;
  replay(rig(), recording, ReplayMode::kReference, [&](double) { return ++calls < 3; });
  EXPECT_EQ(calls, 3);
}

/// 2 s in which the rod is pushed at two points from 0.5 s on, and at one from 1 s to 1.5 s.
Dataset pushed() {
  Dataset recording = loaded(0.0);
  recording.table("joints").columns.pop_back();
  Table& wrenches = recording.table("wrenches");
  for (const double t : {0.5, 1.0, 1.5}) wrenches.t.push_back(std::llround(t * 1e9));
  wrenches.columns = {{"arm/force_x", {1.0, 2.0, 0.0}, {1, 1, 0}},
                      {"arm/point_z", {-0.1, -0.05, 0.0}, {1, 1, 0}},
                      {"arm:2/torque_y", {0.02, 0.0, 0.0}, {1, 0, 0}}};
  return recording;
}

TEST(Replay, PushesLinksAsRecorded) {
  const auto model = rig();
  const int arm = model->skeleton->find_frame("arm");
  ASSERT_GE(arm, 0);
  Simulation sim(model);
  const Dataset recording = pushed();
  const Replay input(model, recording, ReplayMode::kReference);
  ASSERT_TRUE(input.start(sim));
  std::vector<double> angles;
  for (int i = 0; i < 3000; ++i) {
    if (i % 10 == 0) angles.push_back(sim.read_positions()[0]);
    ExternalWrenches& wrenches = sim.external_wrenches();
    if (i >= 500 && i < 1000) {
      wrenches.push({arm, Vec3(0, 0, -0.1), Vec3(1, 0, 0), Vec3::Zero(), 1});
      wrenches.push({arm, Vec3::Zero(), Vec3::Zero(), Vec3(0, 0.02, 0), 1});
    } else if (i >= 1000 && i < 1500) {
      wrenches.push({arm, Vec3(0, 0, -0.05), Vec3(2, 0, 0), Vec3::Zero(), 1});
    }
    sim.step();
  }
  angles.push_back(sim.read_positions()[0]);
  const Dataset replayed = replay(model, recording, ReplayMode::kReference);
  EXPECT_EQ(replayed.find_table("joints")->find("hinge/position")->values, angles);
  EXPECT_GT(std::abs(angles[99] - angles[49]), 1e-3);
  EXPECT_EQ(replayed.find_table("wrenches")->t, recording.find_table("wrenches")->t);
}

TEST(Replay, RefusesPushesOfWhatIsNoLink) {
  const auto why = [](const std::string& column, double value) -> std::string {
    Dataset recording = pushed();
    recording.folder = "run";
    recording.table("wrenches").columns.push_back({column, {value, 0, 0}, {1, 0, 0}});
    try {
      Replay(rig(), recording, ReplayMode::kReference);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(why("arm:3/force_z", 1.0), "accepted");
  EXPECT_EQ(why("amr/force_x", 1.0),
            "run/wrenches.csv: column 'amr/force_x': expected LINK/force_x, torque_x, point_x, ... "
            "of a link of the robot");
  EXPECT_NE(why("arm/position", 1.0).find("expected LINK/force_x"), std::string::npos);
  EXPECT_EQ(why("arm/force_y", std::nan("")),
            "run/wrenches.csv: row 1: arm/force_y: nan: expected a finite number: it drives the "
            "replay");
}

}  // namespace
}  // namespace anthrob
