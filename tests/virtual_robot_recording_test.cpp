// A recording of the virtual robot, read and replayed by the simulator: the same robot, no shared
// code, so without hidden effects and noise they agree.
#include <anthrob_sim/recording/dataset.h>
#include <anthrob_sim/recording/replay.h>
#include <anthrob_virtual_robot/recording.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

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

}  // namespace
}  // namespace anthrob
