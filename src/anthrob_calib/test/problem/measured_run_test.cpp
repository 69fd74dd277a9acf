// What a recording says of a run.
#include "problem/measured_run.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>

#include "anthrob_ecu/state_machine.h"
#include "anthrob_recording/unanswered.h"
#include "two_muscle_rig.h"

namespace anthrob {
namespace calibration {
namespace {

std::string error_of(const Dataset& data) {
  try {
    read_run(data, rig());
  } catch (const BadInput& error) {
    return error.what();
  }
  return "no error";
}

TEST(MeasuredRun, SeesCommandsAndPostures) {
  const MeasuredRun run = read_run(record_simulation(rig(), plan(3.0, 0.0, "trajectory")), rig());
  EXPECT_EQ(run.start, (std::vector<double>{1.0, 1.0}));
  ASSERT_EQ(run.commands.size(), 1u);
  EXPECT_EQ(run.commands[0].reference, (std::vector<double>{3.0, 0.0}));
  EXPECT_NEAR(run.duration, 2.0, 0.006);
  EXPECT_EQ(run.path.count(), 200 + (run.duration > 2.0 - 1e-9));
  EXPECT_EQ(run.before.count(), 1);
  // Pulled by the flexor, the arm moves; before, it stood still.
  EXPECT_NEAR(run.before.q(0, 0), run.path.q(0, 0), 1e-3);
  EXPECT_GT(std::abs(run.after.q(0, 0) - run.before.q(0, 0)), 0.1);
  EXPECT_EQ(run.path.position.cols(), 2);
}

TEST(MeasuredRun, AnEquilibriumToItselfHasACommandToo) {
  const MeasuredRun run = read_run(record_simulation(rig(), plan(1.0, 1.0, "equilibrium")), rig());
  ASSERT_EQ(run.commands.size(), 1u);
  EXPECT_EQ(run.commands[0].reference, run.start);
  EXPECT_EQ(run.path.count(), 0);
}

TEST(MeasuredRun, RefusesBadRecordingsWithOneLine) {
  const Dataset good = record_simulation(rig(), plan(3.0, 0.0, "equilibrium"));
  EXPECT_EQ(error_of(good), "no error");
  const auto expect = [&](const char* part, auto change) {
    Dataset bad = good;
    change(bad);
    const std::string error = error_of(bad);
    EXPECT_NE(error.find(part), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos);
  };
  const auto scale = [](Dataset& d, const char* column, double by) {
    for (double& value : d.tables[0].column(column).values) value *= by;
  };
  expect("expected a position of a joint that goes from",
         [&](Dataset& d) { scale(d, "hinge/position", 180.0 / M_PI); });
  expect("expected the tension of a tendon", [&](Dataset& d) { scale(d, "flexor/force", -1.0); });
  expect("fewer than two rows", [](Dataset& d) { d.tables.clear(); });
  const auto lose = [](Dataset& d, const char* column, std::size_t from, std::size_t count) {
    auto& values = d.tables[0].column(column).values;
    std::fill_n(values.begin() + static_cast<long>(from), count, NAN);
  };
  const std::size_t rows = good.tables[0].t.size();  // 5 ms apart
  expect("flexor/force: not a finite number", [&](Dataset& d) { lose(d, "flexor/force", 7, 10); });
  expect("hinge/position: not a finite number",
         [&](Dataset& d) { lose(d, "hinge/position", rows - 11, 11); });
  expect("flexor/reference: nan: expected a finite number",
         [&](Dataset& d) { lose(d, "flexor/reference", 7, 1); });
  const auto add = [](Dataset& d, const char* column, double value) {
    Table& table = d.tables[0];
    table.columns.push_back(
        {column, std::vector<double>(table.t.size(), value), std::vector<char>(table.t.size(), 1)});
  };
  expect("hinge/load: 0.3: expected 0", [&](Dataset& d) { add(d, "hinge/load", 0.3); });
  expect("no error", [&](Dataset& d) { add(d, "hinge/load", 0.0); });
  expect("start.reference: extensor is not named", [](Dataset& d) {
    d.meta.start = "given";
    d.meta.start_position = {{"flexor", 1.0}};
  });
  expect("'hinge/position' is missing", [](Dataset& d) {
    auto& present = d.tables[0].column("hinge/position").present;
    std::fill(present.begin(), present.end(), 0);
  });
  expect("no such quantity",
         [](Dataset& d) { d.tables[0].column("flexor/force").name = "biceps/force"; });
  expect("meta.yaml: start.settle_s: ", [](Dataset& d) { d.meta.settle_s = 1e9; });
  expect("meta.yaml: model.gravity.2: -3: calibration simulates one robot", [](Dataset& d) {
    d.meta.model = {{"gravity.2", -3.0}};
  });
  expect("expected equilibrium or trajectory", [](Dataset& d) { d.meta.kind = "rig"; });
  expect("after its first command", [](Dataset& d) {
    Table& table = d.tables[0];
    table.t.resize(120);
    for (Column& c : table.columns) c.values.resize(120), c.present.resize(120);
  });
  expect("expected POSITION", [](Dataset& d) {
    Column& mode = d.tables[0].column("flexor/mode");
    mode.values.assign(d.tables[0].t.size(), 3.0);
    mode.present.assign(d.tables[0].t.size(), 1);
  });
  expect("flexor/ecu_state: STOPPING at t = 1.5", [](Dataset& d) {
    Column& state = d.tables[0].column("flexor/ecu_state");
    state.values.assign(d.tables[0].t.size(), 2.0);
    state.present.assign(d.tables[0].t.size(), 1);
    state.values[300] = 3.0;
  });
}

TEST(MeasuredRun, RefusesRobotsThatHaveMoreOrLessThanMotors) {
  const Dataset data = record_simulation(rig(), plan(3.0, 0.0, "equilibrium"));
  const std::filesystem::path config = ANTHROB_CONFIG_DIR;
  const std::pair<const char*, const char*> cases[] = {
      {"driven_axis/model_I.yaml", "driven_axis/model_I.yaml: has no muscles; calibration needs"},
      {"two_muscle_rig/model_hill.yaml", "model_hill.yaml: muscles.flexor: has no controller"}};
  for (const auto& [model, reason] : cases) {
    try {
      read_run(data, load_robot_model((config / model).string()));
      FAIL() << model;
    } catch (const BadInput& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  }
}

TEST(MeasuredRun, BridgesSamplesThatWereLost) {
  const Dataset whole = record_simulation(rig(), plan(3.0, 0.0, "trajectory"));
  const MeasuredRun run = read_run(whole, rig());
  Dataset with_losses = whole;
  const std::size_t rows = whole.tables[0].t.size();
  for (const char* column : {"flexor/force", "flexor/position", "hinge/position"}) {
    auto& values = with_losses.tables[0].column(column).values;
    for (const std::size_t first : {std::size_t{0}, std::size_t{150}, rows - 9}) {
      std::fill_n(values.begin() + static_cast<long>(first), 9, NAN);
    }
  }
  // What the driver says then; the motor goes on.
  Column& state = with_losses.tables[0].column("flexor/ecu_state");
  state.values.assign(rows, static_cast<double>(ecu::State::kEnabled));
  state.present.assign(rows, 1);
  std::fill_n(state.values.begin() + 150, 9, static_cast<double>(ecu::State::kFault));
  leave_out_unanswered(with_losses);
  const MeasuredRun bridged = read_run(with_losses, rig());
  EXPECT_NEAR(bridged.duration, run.duration, 0.05);
  ASSERT_GT(bridged.path.count(), 190);
  const auto count = bridged.path.count();
  EXPECT_TRUE(bridged.path.q.allFinite() && bridged.path.force.allFinite());
  EXPECT_LT((bridged.path.q - run.path.q.topRows(count)).cwiseAbs().maxCoeff(), 0.02);
  EXPECT_EQ(bridged.path.q.row(20), run.path.q.row(20));
}

/// As a bag has it: commands in a table of their own, states that tell what was in force.
Dataset as_in_a_bag(Dataset recording) {
  Table& states = recording.table("muscles");
  const std::size_t rows = states.t.size();
  for (const char* muscle : {"flexor", "extensor"}) {
    states.column(std::string(muscle) + "/mode").values.assign(rows, 1.0);
    states.column(std::string(muscle) + "/ecu_state").values.assign(rows, 2.0);
    for (const char* word : {"/mode", "/ecu_state"}) {
      states.column(std::string(muscle) + word).present.assign(rows, 1);
    }
  }
  Table& commands = recording.table("commands");
  commands.t = {500000000, 700000000};
  for (const char* muscle : {"flexor", "extensor"}) {
    commands.column(std::string(muscle) + "/mode").values = {1.0, 1.0};
    commands.column(std::string(muscle) + "/mode").present = {1, 1};
  }
  commands.column("flexor/reference").values = {3.0, 0.0};
  commands.column("flexor/reference").present = {1, 0};
  commands.column("extensor/reference").values = {0.0, 2.0};
  commands.column("extensor/reference").present = {0, 1};
  return recording;
}

/// What the states say of one muscle from one row to another.
void say(Dataset& recording, const std::string& muscle, std::size_t from, std::size_t to,
         double mode, double reference) {
  Table& states = recording.table("muscles");
  for (std::size_t i = from; i < to; ++i) {
    states.column(muscle + "/mode").values[i] = mode;
    states.column(muscle + "/reference").values[i] = reference;
  }
}

TEST(MeasuredRun, MusclesAreCommandedEachInItsTime) {
  Dataset data = as_in_a_bag(record_simulation(rig(), plan(3.0, 1.0, "trajectory")));
  const std::size_t rows = data.table("muscles").t.size();  // 5 ms apart
  say(data, "extensor", 140, rows, 1.0, 2.0);
  const auto expect_both = [&] {
    const MeasuredRun run = read_run(data, rig());
    EXPECT_EQ(run.start, (std::vector<double>{1.0, 1.0}));
    ASSERT_EQ(run.commands.size(), 2u);
    EXPECT_EQ(run.commands[0].reference, (std::vector<double>{3.0, 1.0}));
    EXPECT_EQ(run.commands[1].reference, (std::vector<double>{3.0, 2.0}));
    EXPECT_NEAR(run.commands[1].t, 0.2, 1e-9);
  };
  expect_both();
  // The same where only the description says where the robot began.
  data.meta.start = "given";
  data.meta.start_position = {{"flexor", 1.0}, {"extensor", 1.0}};
  for (const char* muscle : {"flexor", "extensor"}) {
    for (const char* word : {"/mode", "/reference", "/ecu_state"}) {
      data.table("muscles").column(std::string(muscle) + word).present.assign(rows, 0);
    }
  }
  expect_both();
}

TEST(MeasuredRun, AModeHoldsUntilTheNext) {
  Dataset data = record_simulation(rig(), plan(3.0, 1.0, "trajectory"));
  const std::vector<double> start = read_run(data, rig()).commands[0].reference;
  Table& table = data.table("muscles");
  for (const char* muscle : {"flexor", "extensor"}) {
    Column& mode = table.column(std::string(muscle) + "/mode");
    mode.values.assign(table.t.size(), 1.0);
    mode.present.assign(table.t.size(), 0);
    mode.present[0] = 1;
  }
  EXPECT_EQ(read_run(data, rig()).commands[0].reference, start);
}

TEST(MeasuredRun, ARobotWithoutVoltageIsAtNoReference) {
  Dataset data = as_in_a_bag(record_simulation(rig(), plan(3.0, 1.0, "trajectory")));
  say(data, "flexor", 0, 100, 0.0, 0.0);
  EXPECT_NE(error_of(data).find("flexor: had no voltage when the recording began"),
            std::string::npos)
      << error_of(data);
  data.meta.start = "zero";
  EXPECT_EQ(error_of(data), "no error");
}

TEST(MeasuredRun, WhatWasNotMeasuredForLongIsNoLine) {
  const Dataset good = record_simulation(rig(), plan(3.0, 0.0, "trajectory"));
  const std::size_t rows = good.tables[0].t.size();
  const auto error_without = [&](std::size_t from, std::size_t to) {
    Dataset bad = good;
    auto& present = bad.tables[0].column("hinge/position").present;
    std::fill(present.begin() + static_cast<long>(from), present.begin() + static_cast<long>(to),
              0);
    return error_of(bad);
  };
  EXPECT_EQ(error_without(150, 159), "no error");
  EXPECT_EQ(error_without(150, 170),
            "simulated: hinge/position: nothing measured from t = 0.745000 to 0.850000 s: expected "
            "no gap of more than 0.050000 s");
  EXPECT_NE(error_without(0, 170).find("nothing measured from t = 0.4"), std::string::npos);
  EXPECT_EQ(error_without(20, 60), "no error");  // long before the command, at 0.5 s
  EXPECT_NE(error_without(rows - 50, rows).find("nothing measured from t = 2.2"),
            std::string::npos);
  // Under way when the recorder ended: 95 ms, of which it waits for 50.
  EXPECT_EQ(error_without(rows - 19, rows), "no error");
  EXPECT_NE(error_without(rows - 22, rows).find("nothing measured"), std::string::npos);
}

TEST(MeasuredRun, AnOrientationAndItsNegativeAreTheSame) {
  const auto model = load_robot_model(ANTHROB_CONFIG_DIR "/anthrob/model_II_tier1.yaml");
  RecordingPlan motion;
  motion.kind = "trajectory";
  motion.from.assign(model->muscles.size(), 1.0);
  motion.to.assign(model->muscles.size(), 2.0);
  const Dataset plain = record_simulation(model, motion);
  Dataset turned = plain;
  Table& table = turned.tables[0];
  for (const char* part : {"shoulder/w", "shoulder/x", "shoulder/y", "shoulder/z"}) {
    auto& values = table.column(part).values;
    for (std::size_t i = 1; i < values.size(); i += 2) values[i] = -values[i];
  }
  SamplingOptions between;
  between.rate = 70.0;  // not where something was measured
  const MeasuredRun a = read_run(plain, model, between), b = read_run(turned, model, between);
  EXPECT_GT((a.path.q.row(0) - a.path.q.row(a.path.count() - 1)).norm(), 0.05);
  EXPECT_EQ(b.path.q, a.path.q);
  EXPECT_EQ(b.after.q, a.after.q);
}

TEST(MeasuredRun, KnowsOfHowManyMeasurementsItsMeansAre) {
  Dataset data = record_simulation(rig(), plan(3.0, 0.0, "trajectory"));
  const MeasuredRun run = read_run(data, rig());
  for (const Samples* mean : {&run.before, &run.after}) {
    EXPECT_NEAR(mean->posture_measurements, 21.0, 1.0);  // 0.1 s at 200 Hz
    EXPECT_NEAR(mean->force_measurements, 21.0, 1.0);
  }
  EXPECT_EQ(run.path.force_measurements, 1.0);
  // A camera of 40 Hz.
  auto& present = data.tables[0].column("hinge/position").present;
  for (std::size_t i = 0; i < present.size(); ++i) present[i] = i % 5 == 0 ? 1 : 0;
  const MeasuredRun slow = read_run(data, rig());
  EXPECT_NEAR(slow.after.posture_measurements, 4.0, 1.0);
  EXPECT_NEAR(slow.after.force_measurements, 21.0, 1.0);
}

TEST(MeasuredRun, IsCalledAsItsFile) {
  Dataset data = record_simulation(rig(), plan(3.0, 0.0, "trajectory"));
  for (const auto& [path, name] : std::map<std::string, std::string>{
           {"runs/E_0.5", "E_0.5"}, {"runs/E1/", "E1"}, {"runs/E_0.5.bag", "E_0.5"}}) {
    data.folder = path;
    EXPECT_EQ(read_run(data, rig()).name, name);
  }
}

}  // namespace
}  // namespace calibration
}  // namespace anthrob
