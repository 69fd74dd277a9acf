// What command-line tools say about a model file.
#include "anthrob_sim/tool.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "anthrob_core/errors.h"
#include "support.h"

namespace anthrob {
namespace {

namespace fs = std::filesystem;

/// A robot with a bone one facet of which faces inwards.
class OddRobot : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("anthrob_odd_" + std::to_string(getpid()));
    fs::copy(testing_support::config("anthrob"), folder_, fs::copy_options::recursive);
    // Binary STL: header of 84 bytes, then normal and corners of 12 bytes each.
    std::fstream bone(folder_ / "meshes/scapula.stl",
                      std::ios::in | std::ios::out | std::ios::binary);
    char corners[24];
    bone.seekg(84 + 12).read(corners, 24);
    bone.seekp(84 + 12).write(corners + 12, 12).write(corners, 12);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(OddRobot, IsRemarkedOnAndUsed) {
  CLI::App app("", "anthrob_something");
  testing::internal::CaptureStderr();
  const auto model = tool::load_model(app, (folder_ / "model_III.yaml").string());
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_EQ(model->muscles.size(), 11u);
  EXPECT_EQ(said.find("anthrob_something: " + folder_.string()), 0u) << said;
  EXPECT_NE(said.find("meshes/scapula.stl: 3 edges between facets that face opposite ways"),
            std::string::npos)
      << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1);
}

TEST(Tool, SaysNothingAboutASoundModel) {
  CLI::App app("", "anthrob_something");
  testing::internal::CaptureStderr();
  tool::load_model(app, testing_support::config("anthrob/model_III.yaml"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ParseRange, SplitsNameEndsAndPoints) {
  const tool::Range range = tool::parse_range("--sweep", "shoulder_x=-1:1.5:100000");
  EXPECT_EQ(range.name, "shoulder_x");
  EXPECT_EQ(range.from, -1.0);
  EXPECT_EQ(range.to, 1.5);
  EXPECT_EQ(range.points, 100000);
}

TEST(ParseRange, RefusesAnyOtherFormAndTooManyPoints) {
  const auto said = [](const std::string& text) -> std::string {
    try {
      tool::parse_range("--sweep", text);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "accepted";
  };
  for (const char* text : {"elbow", "=0:2:5", "elbow=0", "elbow=0:2", "elbow=:2:5", "elbow=0:two:5",
                           "elbow=0:inf:5", "elbow=0x:2:5"}) {
    EXPECT_EQ(said(text), "--sweep " + std::string(text) + ": expected NAME=FROM:TO:POINTS");
  }
  for (const char* text : {"elbow=0:2:", "elbow=0:2:1", "elbow=0:2:-5", "elbow=0:2:5.5",
                           "elbow=0:2:5:6", "elbow=0:2:100001", "elbow=0:2:99999999999"}) {
    EXPECT_EQ(said(text), "--sweep " + std::string(text) +
                              ": expected a whole number of POINTS from 2 to 100000");
  }
}

TEST(ProgressText, SaysWhatIsLeftWhereThatIsKnown) {
  EXPECT_EQ(tool::progress_text(0.25, 10.0), " 25 %, 30 s left");
  EXPECT_EQ(tool::progress_text(1.0, 10.0), "100 %, 10 s so far");
  EXPECT_EQ(tool::progress_text(0.0, 10.0), "  0 %, 10 s so far");
}

}  // namespace
}  // namespace anthrob
