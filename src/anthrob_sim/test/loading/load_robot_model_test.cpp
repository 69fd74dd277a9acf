// Robots from descriptions whose files are read once.
#include <gtest/gtest.h>

#include <thread>

#include "anthrob_core/errors.h"
#include "anthrob_sim/simulation.h"
#include "support.h"

namespace anthrob {
namespace {

namespace fs = std::filesystem;

/// A copy of Anthrob's files that can be taken away.
class CopiedArm {
 public:
  CopiedArm()
      : folder_(fs::temp_directory_path() / ("anthrob_copied_arm_" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::copy(testing_support::config("anthrob"), folder_, fs::copy_options::recursive);
  }
  ~CopiedArm() { take_away(); }
  CopiedArm(const CopiedArm&) = delete;
  CopiedArm& operator=(const CopiedArm&) = delete;

  std::string file() const { return (folder_ / "model_III.yaml").string(); }
  void take_away() const { fs::remove_all(folder_); }

 private:
  fs::path folder_;
};

/// Other numbers of a muscle, of a mesh (which is prepared anew), and an effect.
LoadOptions variant() {
  LoadOptions options;
  options.step = 0.0005;
  options.overrides = {{"muscles.biceps_brachii.spindle_radius", 0.007},
                       {"muscles.anterior_deltoid.path.3.mesh.offset.0", 0.0005}};
  options.effects = {{"gear_backlash", "biceps_brachii", {{"width", 0.01}}}};
  return options;
}

std::vector<double> state_after(const std::shared_ptr<const RobotModel>& model) {
  Simulation sim(model);
  sim.command(model->muscle_index("biceps_brachii"), ecu::Mode::kPosition, 2.0);
  sim.step(50);
  return sim.snapshot().state;
}

TEST(RobotDescription, BuildsVariantsWithoutItsFiles) {
  const CopiedArm arm;
  const RobotDescription description = RobotDescription::load(arm.file());
  const auto plain = load_robot_model(arm.file());
  const auto varied = load_robot_model(arm.file(), variant());
  arm.take_away();
  ASSERT_THROW(load_robot_model(arm.file()), BadInput);

  EXPECT_EQ(state_after(description.build()), state_after(plain));
  const auto built = description.build(variant());
  EXPECT_EQ(state_after(built), state_after(varied));
  EXPECT_NE(state_after(built), state_after(plain));
  EXPECT_EQ(built->name, varied->name);
  EXPECT_EQ(built->urdf_file, varied->urdf_file);
}

TEST(RobotDescription, BuildsInSeveralThreadsAtOnce) {
  const RobotDescription description =
      RobotDescription::load(testing_support::config("anthrob/model_III.yaml"));
  const std::vector<double> expected = state_after(description.build(variant()));
  std::vector<std::vector<double>> states(4);
  std::vector<std::thread> threads;
  for (auto& state : states) {
    threads.emplace_back([&] { state = state_after(description.build(variant())); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& state : states) EXPECT_EQ(state, expected);
}

TEST(RobotDescription, KeepsNothingOfAVariant) {
  const RobotDescription description =
      RobotDescription::load(testing_support::config("anthrob/model_II.yaml"));
  const std::vector<double> before = state_after(description.build());
  LoadOptions bad;
  bad.overrides = {{"muscles.biceps_brachii.spindle_radius", -1.0}};
  EXPECT_THROW(description.build(bad), BadInput);
  LoadOptions other;
  other.overrides = {{"muscles.biceps_brachii.spindle_radius", 0.007}};
  EXPECT_NE(state_after(description.build(other)), before);
  EXPECT_EQ(state_after(description.build()), before);
}

TEST(RobotDescription, RefusesWhatItsFilesLack) {
  const CopiedArm arm;
  fs::remove_all(fs::path(arm.file()).parent_path() / "meshes");
  try {
    RobotDescription::load(arm.file()).build();
    FAIL() << "built without meshes";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("no such file"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace anthrob
