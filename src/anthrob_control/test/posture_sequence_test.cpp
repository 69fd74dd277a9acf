#include "anthrob_control/posture_sequence.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>

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
      {"postures: [{name: a, hold: 0}]\n", "hold"},
      {"postures: [{name: a, hold: 1, joints: {knee: 1}}]\n", "knee"},
      {"postures: [{name: a, hold: 1, joints: {elbow: 3}}]\n", "elbow"},
      {"postures: [{name: a, hold: 1, joints: {shoulder: [1, 1, 0, 0]}}]\n", "unit quaternion"},
      {"postures: [{name: a, hold: 1, speed: 3}]\n", "unknown key"},
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

TEST(PostureSequence, SaysWhenAPostureCannotBeHeld) {
  const auto model =
      load_robot_model(kConfig + "/two_muscle_rig/model_I.yaml", {1e-3, {{"gravity.2", -9.81}}});
  PostureSequence sequence;
  sequence.options.highest_tension = 2.0;
  sequence.steps.push_back({"horizontal", {1.5}, 1.0});
  EXPECT_THROW(sequence.references(model), BadInput);
}

}  // namespace
}  // namespace anthrob
