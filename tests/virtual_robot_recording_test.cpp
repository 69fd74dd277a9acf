// A recording of the virtual robot, read and replayed by the simulator: the same robot, no shared
// code, so without hidden effects and noise they agree.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/replay/replay.h"
#include "recording.h"
#include "session.h"

namespace anthrob {
namespace {

TEST(VirtualRobotRecording, IsReadAndReplayed) {
  const std::string model_file = std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml";
  virtual_robot::Draft draft;
  draft.arm = reference::Arm::load(model_file);
  const auto believed = draft.arm;
  virtual_robot::Robot robot(std::move(draft), nullptr, 0);
  constexpr double kSeconds = 6.0;
  const auto commands = virtual_robot::excitation(believed, kSeconds, virtual_robot::Random(1));
  virtual_robot::RecordingSettings settings;
  settings.settle = 8.0;  // the ways there differ
  virtual_robot::Meta meta;
  meta.settle = settings.settle;
  std::vector<std::string> names;
  for (const auto& muscle : believed.muscles) names.push_back(muscle.name);
  const auto folder = std::filesystem::temp_directory_path() /
                      ("anthrob_virtual_robot_" + std::to_string(getpid()));
  virtual_robot::write_dataset(virtual_robot::record(&robot, commands, kSeconds, settings), names,
                               settings, meta, folder.string());

  const Dataset recorded = Dataset::load(folder.string());
  std::filesystem::remove_all(folder);
  EXPECT_EQ(recorded.meta.robot, "anthrob");
  EXPECT_EQ(recorded.find_table("muscles")->t.size(), 1201u);
  const Dataset simulated = replay(load_robot_model(model_file), recorded, ReplayMode::kReference);
  const auto rms = [&](const std::string& column) {
    const Series a = recorded.series(column), b = simulated.series(column);
    double sum = 0.0;
    for (std::size_t i = 0; i < a.t.size(); ++i) sum += std::pow(a.values[i] - b.at(a.t[i]), 2);
    return std::sqrt(sum / static_cast<double>(a.t.size()));
  };
  EXPECT_LT(rms("elbow/position"), 0.005);
  for (const char* axis : {"x", "y", "z"}) EXPECT_LT(rms(std::string("shoulder/") + axis), 0.005);
  for (const std::string& name : names) {
    EXPECT_LT(rms(name + "/force"), 0.5) << name;
    EXPECT_LT(rms(name + "/position"), 0.01) << name;
  }
}

TEST(VirtualRobotSession, TheWayBackBeginsWhereTheWayThereEnded) {
  const std::string folder = std::string(ANTHROB_CONFIG_DIR) + "/anthrob/";
  const auto plain = reference::Arm::load(folder + "model_I.yaml");
  auto settings =
      virtual_robot::CalibrationRobotSettings::load(folder + "virtual_robot_tables.yaml");
  settings.tries = 1;
  virtual_robot::Session session(
      [&](std::uint64_t) {
        return virtual_robot::Robot(virtual_robot::with_hidden(plain, settings), nullptr, 0);
      },
      plain, settings, true);
  auto targets =
      virtual_robot::load_targets(folder + "equilibria_tier2.yaml", settings.lowest_tension);
  targets.resize(2);
  session.find_references(targets);
  const auto out = std::filesystem::temp_directory_path() /
                   ("anthrob_virtual_session_" + std::to_string(getpid()));
  session.record_trajectories({}, out.string());
  const std::string home = targets[0].name, away = targets[1].name;
  const Dataset there = Dataset::load((out / (home + "_to_" + away + "_run1")).string());
  const Dataset back = Dataset::load((out / (away + "_to_" + home + "_run1")).string());
  std::filesystem::remove_all(out);
  // A control period lies between the two.
  for (const Table& table : there.tables) {
    if (table.name == "commands") continue;
    for (const Column& column : table.columns) {
      const double last = there.series(column.name).values.back();
      EXPECT_NEAR(back.series(column.name).values.front(), last, 1e-3 + 0.01 * std::abs(last))
          << column.name;
    }
  }
  const std::string muscle = there.tables.front().columns.front().owner();
  EXPECT_EQ(back.series(muscle + "/reference").values.front(),
            there.series(muscle + "/reference").values.back());
}

}  // namespace
}  // namespace anthrob
