// The protocols that discovery writes to tell rivals apart are protocols that the recorder runs:
// its own reader takes them, with every target and every muscle.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "experiment/simulated_recording.h"
#include "protocol.h"
#include "report/separating_files.h"

namespace anthrob {
namespace {

using discovery::Answer;
using discovery::Evaluator;
using discovery::Experiments;
using discovery::FoundEffect;
using discovery::Scales;
using discovery::SeparatingRecording;
using discovery::Variant;

constexpr double kDigits = 1e-5;  // six digits are written

class Protocols : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static std::string model_file(const std::string& name) {
    return std::string(ANTHROB_CONFIG_DIR) + "/" + name;
  }

  /// What the recorder reads of the files that discovery writes for the second of two effects.
  Protocol read_back(const SeparatingRecording& plan,
                     const std::shared_ptr<const RobotModel>& model) const {
    FoundEffect effect;
    effect.id = "joint_coulomb";
    effect.place = "elbow";
    effect.rivals = {{"joint_viscous", "Viscous joint friction", "elbow", 0.3, 10.0}};
    Answer answer;
    answer.effects = {effect, effect};
    answer.effects[1].separating_recording = plan;
    for (const auto& [name, text] : separating_files(answer, *model)) {
      std::ofstream(folder_ / name) << text;
    }
    return Protocol::load((folder_ / discovery::separating_file(2)).string(), model);
  }

  void expect_kept(const SeparatingRecording& plan, const RobotModel& model,
                   const Protocol& protocol) const {
    EXPECT_EQ(protocol.kind, Protocol::Kind::kTrajectories) << "to each target and back";
    EXPECT_EQ(protocol.repeats, 1);
    EXPECT_DOUBLE_EQ(protocol.hold, 0.5);
    EXPECT_DOUBLE_EQ(protocol.average, 0.1);
    EXPECT_DOUBLE_EQ(protocol.settle.actuator_velocity, 0.02);
    EXPECT_DOUBLE_EQ(protocol.settle.joint_velocity, 0.01);
    EXPECT_DOUBLE_EQ(protocol.settle.window, 0.5);
    EXPECT_DOUBLE_EQ(protocol.settle.timeout, 20.0);
    EXPECT_EQ(protocol.redo, 1);
    EXPECT_EQ(protocol.rest.name, "rest");
    expect_references(plan.rest, model, protocol.rest);
    ASSERT_EQ(protocol.targets.size(), plan.targets.size());
    for (std::size_t i = 0; i < plan.targets.size(); ++i) {
      EXPECT_EQ(protocol.targets[i].name, plan.targets[i].name);
      expect_references(plan.targets[i].references, model, protocol.targets[i]);
    }
  }

 private:
  static void expect_references(const std::vector<double>& expected, const RobotModel& model,
                                const Protocol::Target& target) {
    EXPECT_TRUE(target.by_references) << target.name;
    ASSERT_EQ(target.reference.size(), model.muscles.size());
    for (std::size_t m = 0; m < model.muscles.size(); ++m) {
      EXPECT_NEAR(target.reference[m], expected[m], kDigits)
          << target.name << " " << model.muscles[m].name;
    }
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("separating_protocol_" + std::to_string(getpid()));
};

/// References that differ from muscle to muscle, so that an exchange shows.
std::vector<double> references(const RobotModel& model, double offset) {
  std::vector<double> list;
  for (std::size_t m = 0; m < model.muscles.size(); ++m) {
    list.push_back(offset + 0.1234567 * static_cast<double>(m));
  }
  return list;
}

TEST_F(Protocols, KeepDurationsTargetsAndMuscles) {
  for (const char* name : {"anthrob/model_I.yaml", "anthrob/model_I_tier1.yaml",
                           "anthrob/model_I_hand.yaml", "two_muscle_rig/model_I.yaml"}) {
    SCOPED_TRACE(name);
    const auto model = load_robot_model(model_file(name));
    SeparatingRecording plan;
    plan.rest = references(*model, 0.0);
    plan.targets = {{"P2_tight", references(*model, 0.35), 40.0},
                    {"P1", references(*model, -1.5), 12.4},
                    {"P1_little", references(*model, 0.01), 0.2}};
    for (std::size_t m = 0; m < model->muscles.size(); ++m) {
      // As references_in() has it: what no controller follows has no reference.
      if (model->muscles[m].has_controller) continue;
      plan.rest[m] = 0.0;
      for (auto& target : plan.targets) target.references[m] = 0.0;
    }
    expect_kept(plan, *model, read_back(plan, model));
  }
}

TEST_F(Protocols, OfAPlannedRecordingAreTakenByTheRecorder) {
  const std::string file = model_file("two_muscle_rig/model_I.yaml");
  const Evaluator evaluator(file, {}, 0.001, 1);
  const RobotModel& model = *evaluator.model();
  Variant named, rival;
  named.effects = {{"joint_coulomb", "hinge", {{"torque", 0.05}}}};
  rival.effects = {{"joint_viscous", "hinge", {{"damping", 0.1}}}};
  SeparatingRecording made;
  made.rest = {1.0, 1.0};
  made.targets = {{"a", {4.0, 0.5}}, {"b", {0.5, 4.0}}, {"c", {3.0, 3.0}}};
  const Dataset recording = discovery::simulated_recording(
      evaluator.build(named), separating_commands(model, made, {}), 1, {});
  const Experiments experiments = {discovery::make_experiment(model, recording, {})};
  Scales scales;
  for (const auto& channel : discovery::channels_of(experiments))
    scales[channel.name()].floor = 0.01;
  const SeparatingRecording plan =
      plan_separation(evaluator, named, rival, recording, scales, 0.02, {});
  ASSERT_FALSE(plan.targets.empty());
  ASSERT_GT(plan.distance(), 0.0);
  expect_kept(plan, model, read_back(plan, evaluator.model()));
}

}  // namespace
}  // namespace anthrob
