#include "output_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

namespace anthrob {
namespace discovery {
namespace {

TEST(SeparatingRecording, ProtocolsOfAnEarlierAnswerGo) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("protocols_" + std::to_string(getpid()));
  fs::create_directories(folder / "separating_1_train");
  for (const char* name : {"separating_1.yaml", "separating_1_postures.yaml", "separating_2.yaml",
                           "separating_1_train/meta.yaml", "model.yaml"}) {
    std::ofstream(folder / name) << "{}";
  }
  remove_other_protocols(folder.string(), {{"separating_2.yaml", "{}"}});
  std::set<std::string> left;
  for (const auto& entry : fs::directory_iterator(folder)) left.insert(entry.path().filename());
  EXPECT_EQ(left, (std::set<std::string>{"model.yaml", "separating_1_train", "separating_2.yaml"}));
  fs::remove_all(folder);
}

TEST(ClosedLoop, RecordingsOfAnEarlierOneGo) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("loop_" + std::to_string(getpid()));
  for (const char* name :
       {"separating_1_train", "separating_2_train", "separating_2_test", "mine"}) {
    fs::create_directories(folder / name);
    for (const char* file : {"meta.yaml", "muscles.csv"}) std::ofstream(folder / name / file) << "";
  }
  std::ofstream(folder / "separating_2_test/notes.txt") << "mine";
  remove_other_recordings(folder.string(), {"separating_1_train", "separating_1_test"}, {});
  EXPECT_TRUE(fs::exists(folder / "separating_1_train/muscles.csv"));
  EXPECT_FALSE(fs::exists(folder / "separating_2_train"));
  EXPECT_FALSE(fs::exists(folder / "separating_2_test/muscles.csv"));
  EXPECT_TRUE(fs::exists(folder / "separating_2_test/notes.txt"));
  EXPECT_TRUE(fs::exists(folder / "mine/muscles.csv"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
