// The virtual robot's controllers follow the model's law, with noisy measurements that nobody
// records: nothing about how it was recorded may be taken for another law, or for late stamps.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "anthrob_sim/model/robot_model.h"
#include "measurement/stamp_correction.h"

namespace anthrob {
namespace {

TEST(VirtualRobotMeasurement, ItsVoltagesFollowTheModelsLaw) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("anthrob_measurement_" + std::to_string(getpid()));
  const std::string make = std::string(ANTHROB_BLIND_CASE) +
                           " --hide joint_coulomb@elbow --seed 1 --model " + ANTHROB_CONFIG_DIR +
                           "/anthrob/model_I.yaml --out " + (folder / "case").string() +
                           " --truth " + (folder / "truth.json").string();
  ASSERT_EQ(std::system(make.c_str()), 0);
  discovery::Description description;
  for (const char* name : {"train_0", "train_1", "test_0", "repeat_0"}) {
    description.question.train.push_back(Dataset::load((folder / "case" / name).string()));
  }
  const std::string model_file = (folder / "case/model.yaml").string();
  discovery::correct_controller_stamps(*load_robot_model(model_file), ConfigNode::load(model_file),
                                       description);
  std::filesystem::remove_all(folder);
  EXPECT_TRUE(description.measurement.empty());
  EXPECT_TRUE(description.remarks.empty()) << description.remarks.front();
}

}  // namespace
}  // namespace anthrob
