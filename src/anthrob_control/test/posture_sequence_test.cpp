#include "anthrob_control/posture_sequence.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "anthrob_sim/skeleton/skeleton_model.h"

namespace anthrob {
namespace {

const std::string kConfig = ANTHROB_CONFIG_DIR;

class File {
 public:
  explicit File(const std::string& text)
      : path_("/tmp/anthrob_postures_" + std::to_string(getpid()) + ".yaml") {
    std::ofstream(path_) << text;
  }
  ~File() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

TEST(PostureSequence, TheDemoCanBeHeldByBothModels) {
  for (const char* name : {"I", "II"}) {
    const auto model = load_robot_model(kConfig + "/anthrob/model_" + name + ".yaml");
    const auto sequence = PostureSequence::load(kConfig + "/anthrob/demo_postures.yaml", *model);
    EXPECT_GE(sequence.steps.size(), 5u);
    const auto references = sequence.references(model);
    ASSERT_EQ(references.size(), sequence.steps.size());
    EXPECT_EQ(references[0].size(), 11u);
  }
}

TEST(PostureSequence, RefusesWhatItCannotUse) {
  const auto model = load_robot_model(kConfig + "/anthrob/model_I.yaml");
  const struct {
    const char* text;
    const char* expected;
  } cases[] = {
      {"postures: []\n", "at least one"},
      {"lowest_tension: 121\npostures: [{name: a}]\n", "lowest_tension: 121: expected"},
      {"postures: [{name: a, hold: 0}]\n", "hold"},
      {"postures: [{name: a, hold: 1e10}]\n", "hold: 1e10: expected"},
      {"postures: [{name: '1'}]\n", "1: expected a name with a letter"},
      {"postures: [{name: a, joints: {elbow: 1}, references: {brachialis: 1}}]\n",
       "has joints and references; expected one of them"},
      {"postures: [{name: abduction/60}]\n", "abduction/60: expected letters, digits"},
      {"postures: [{name: 'a, b'}]\n", "a, b: expected letters, digits"},
      {"postures: [{name: '[x'}]\n", "[x: expected letters, digits"},
      {"postures: [{name: a, hold: 1, joints: {knee: 1}}]\n", "knee"},
      {"postures: [{name: a, hold: 1, joints: {elbow: 3}}]\n", "elbow"},
      {"postures: [{name: a, hold: 1, joints: {shoulder: [1, 1, 0, 0]}}]\n", "unit quaternion"},
      {"postures: [{name: a, hold: 1, speed: 3}]\n", "unknown key"},
      {"postures: [{name: a, references: {nobody: 1}}]\n", "nobody"},
      {"postures: [{name: a, references: {brachialis: 99}}]\n", "brachialis"},
      {"postures: [{name: a, references: {brachialis: 1}}]\n", "'lateral_deltoid' is missing"},
  };
  for (const auto& test : cases) {
    const File file(test.text);
    try {
      PostureSequence::load(file.path(), *model);
      FAIL() << test.text;
    } catch (const BadInput& error) {
      EXPECT_NE(std::string(error.what()).find(test.expected), std::string::npos) << error.what();
    }
  }
}

TEST(PostureSequence, ThesisEquilibriaCanBeHeldByTheirModels) {
  for (const std::string name : {"I", "II"}) {
    const auto one = load_robot_model(kConfig + "/anthrob/model_" + name + "_tier1.yaml");
    EXPECT_EQ(one->muscles.size(), 8u);
    EXPECT_EQ(one->skeleton->joints.size(), 1u);
    const auto tier1 = PostureSequence::load(kConfig + "/anthrob/equilibria_tier1.yaml", *one);
    EXPECT_EQ(tier1.references(one).size(), 17u);
    const auto two = load_robot_model(kConfig + "/anthrob/model_" + name + ".yaml");
    const auto tier2 = PostureSequence::load(kConfig + "/anthrob/equilibria_tier2.yaml", *two);
    EXPECT_EQ(tier2.references(two).size(), 6u);
  }
}

TEST(PostureSequence, ThesisEquilibriaHaveTheDistancesOfTheTables) {
  const auto model = load_robot_model(kConfig + "/anthrob/model_I_tier1.yaml");
  const auto steps =
      PostureSequence::load(kConfig + "/anthrob/equilibria_tier1.yaml", *model).steps;
  const auto distance = [&](int a, int b) {
    return joint_distance(model->skeleton->joints[0], steps[a].q, steps[b].q) * 180.0 / M_PI;
  };
  // Table C.10.
  EXPECT_NEAR(distance(0, 1), 10.35, 0.01);
  EXPECT_NEAR(distance(0, 11), 48.57, 0.01);
  EXPECT_NEAR(distance(3, 16), 49.76, 0.01);
  EXPECT_NEAR(distance(11, 16), 3.42, 0.01);
}

TEST(PostureSequence, IsRefusedForARobotThatTakesNoPositions) {
  const auto model = load_robot_model(kConfig + "/two_muscle_rig/model_hill.yaml");
  const File file("postures: [{name: a, hold: 1}]\n");
  const auto sequence = PostureSequence::load(file.path(), *model);
  EXPECT_THROW(sequence.references(model), BadInput);
}

TEST(PostureSequence, TakesReferencesAsTheyWereRecorded) {
  const auto model = load_robot_model(kConfig + "/two_muscle_rig/model_I.yaml");
  const File file("postures: [{name: a, references: {flexor: 1.5, extensor: -0.5}}]\n");
  const auto sequence = PostureSequence::load(file.path(), *model);
  EXPECT_EQ(sequence.references(model)[0], (std::vector<double>{1.5, -0.5}));
}

TEST(PostureSequence, RefusesWhatIsBeyondAStopOrALimit) {
  const auto torso = load_robot_model(kConfig + "/torso_100/model_II.yaml");
  const File near("postures: [{name: a, joints: {neck: [0.9553, 0.2955, 0, 0]}}]\n");  // 0.6 rad
  EXPECT_EQ(PostureSequence::load(near.path(), *torso).steps.size(), 1u);
  const File far("postures: [{name: a, joints: {neck: [0.5403, 0.8415, 0, 0]}}]\n");  // 2 rad
  EXPECT_THROW(PostureSequence::load(far.path(), *torso), BadInput);

  const auto model = load_robot_model(kConfig + "/two_muscle_rig/model_I.yaml",
                                      {1e-3, {{"controllers.pd.limits.position", 0.2}}});
  PostureSequence sequence;
  sequence.steps.push_back({"bent", {1.0}, 1.0, {}});
  EXPECT_THROW(sequence.references(model), BadInput);
}

TEST(PostureSequence, SaysWhenAPostureCannotBeHeld) {
  const auto model =
      load_robot_model(kConfig + "/two_muscle_rig/model_I.yaml", {1e-3, {{"gravity.2", -9.81}}});
  PostureSequence sequence;
  sequence.options.highest_tension = 2.0;
  sequence.steps.push_back({"horizontal", {1.5}, 1.0, {}});
  EXPECT_THROW(sequence.references(model), BadInput);
}

}  // namespace
}  // namespace anthrob
