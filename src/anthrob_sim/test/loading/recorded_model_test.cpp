// Robots as they were in a recording.
#include "anthrob_sim/model/recorded_model.h"

#include <gtest/gtest.h>

#include "anthrob_core/errors.h"
#include "support.h"

namespace anthrob {
namespace {

std::string refusal_of_recorded(const RobotDescription& robot, const Dataset& recording) {
  try {
    build_recorded(robot, recording);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "no error";
}

TEST(RecordedModel, HasTheNumbersOfTheRecording) {
  const auto robot = RobotDescription::load(testing_support::config("two_muscle_rig/model_I.yaml"));
  Dataset recording;
  EXPECT_EQ(build_recorded(robot, recording)->gravity.z(), -9.81);
  recording.meta.model = {{"gravity.2", -1.62}};
  LoadOptions options;
  options.overrides = {{"gravity.2", -3.0}, {"gravity.0", 0.5}};
  // What is known of the recording counts; the rest is free.
  EXPECT_EQ(build_recorded(robot, recording, options)->gravity, Vec3(0.5, 0.0, -1.62));
}

TEST(RecordedModel, SaysWhichNumberOfWhichRecordingIsWrong) {
  const auto robot = RobotDescription::load(testing_support::config("two_muscle_rig/model_I.yaml"));
  Dataset recording;
  recording.folder = "heavy_run";
  for (const char* path : {"gravitation", "gravity", "gravity.3", "robot"}) {
    recording.meta.model = {{path, 1.5}};
    const std::string line = refusal_of_recorded(robot, recording);
    EXPECT_NE(line.find(std::string("heavy_run: meta.yaml: model.") + path + ": 1.5: expected"),
              std::string::npos)
        << line;
  }
  recording.meta.model = {{"muscles.flexor.spindle_radius", -1.0}};
  const std::string line = refusal_of_recorded(robot, recording);
  EXPECT_NE(line.find("heavy_run: meta.yaml: model: "), std::string::npos) << line;
  EXPECT_NE(line.find("muscles.flexor.spindle_radius: -1: expected"), std::string::npos) << line;
}

}  // namespace
}  // namespace anthrob
