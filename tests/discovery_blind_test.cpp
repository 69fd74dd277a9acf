// The blind test of discovery in small: short recordings of virtual robots with something, nothing,
// or something unknown hidden in them, the real programs, a part of the catalogue.
// ./catkin_ws.sh study discovery is the whole of it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// What is hidden, and what would look like it.
const char* const kCatalogue =
    "joint_coulomb,joint_viscous,joint_offset_torque,gravity_tilt,payload,force_sensor_gain,"
    "force_sensor_offset,series_resistance,mocap_misalignment,mocap_delay";

struct Case {
  const char *name, *hidden;
};
constexpr Case kCases[] = {
    {"coulomb", "--hide joint_coulomb@elbow"},
    {"payload", "--hide payload@forearm"},
    {"gain", "--hide force_sensor_gain@biceps_brachii"},
    {"misalignment", "--hide mocap_misalignment@y"},
    {"null_0", "--kind null --case 0"},
    {"outside", "--kind outside --case 3"},
};

class BlindTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void carry_out(const Case& one) const {
    const std::string data = path(std::string("cases/") + one.name), log = path("log_") + one.name;
    const std::string make = std::string(ANTHROB_BLIND_CASE) + " " + one.hidden +
                             " --seed 11 --model " + ANTHROB_CONFIG_DIR +
                             "/anthrob/model_I.yaml --config " + ANTHROB_BLIND_DIR +
                             "/virtual_robot.yaml --out " + data + " --truth " +
                             path(std::string("sealed/") + one.name + ".json");
    const std::string discover =
        std::string(ANTHROB_DISCOVER) + " --model " + data + "/model.yaml --train " + data +
        "/train_0 --test " + data + "/test_0 --repeat " + data + "/repeat_0 --effects " +
        kCatalogue + " --calibration " + ANTHROB_BLIND_DIR +
        "/calibration.yaml --max-effects 1 --jobs 1 --out " + path("reports/") + one.name;
    EXPECT_EQ(std::system(("(" + make + " && " + discover + ") >" + log + " 2>&1").c_str()), 0)
        << one.name << ":\n"
        << std::ifstream(log).rdbuf();
  }

  const fs::path folder_ =
      fs::temp_directory_path() / ("anthrob_blind_" + std::to_string(getpid()));
};

TEST_F(BlindTest, EffectsAreNamedNothingIsNotAndTheUnknownIsNotConfidentlyWrong) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < std::size(kCases); i = next++) carry_out(kCases[i]);
  };
  std::thread second(work);
  work();
  second.join();
  ASSERT_EQ(std::system((std::string(ANTHROB_SCORE) + " --truths " + path("sealed") +
                         " --reports " + path("reports") + " --out " + path("score.json"))
                            .c_str()),
            0);
  const auto score = nlohmann::json::parse(std::ifstream(path("score.json")));
  const auto& effects = score["effect"];
  EXPECT_EQ(effects["cases"], 4);
  EXPECT_GE(effects["first"].get<int>() + effects["in_class"].get<int>(), 4);
  EXPECT_GE(effects["right_place"], 4);
  EXPECT_EQ(score["null"]["cases"], 1);
  EXPECT_EQ(score["null"]["false"], 0);
  EXPECT_EQ(score["outside"]["cases"], 1);
  EXPECT_EQ(score["outside"]["confidently_wrong"], 0);
  if (HasFailure()) std::cout << score["cases"].dump(1) << "\n";
}

}  // namespace
