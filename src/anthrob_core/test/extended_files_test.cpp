// A file that is not there is refused with what there is instead.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "anthrob_core/config_node.h"
#include "anthrob_core/errors.h"

namespace anthrob {
namespace {

class MissingFile : public ::testing::Test {
 protected:
  MissingFile() {
    std::filesystem::create_directories(folder_);
    for (const char* name : {"model_II.yaml", "model_I.yaml", "model_.yaml", "control.yaml"}) {
      std::ofstream(folder_ + "/" + name) << "key: 1\n";
    }
  }
  ~MissingFile() override { std::filesystem::remove_all(folder_); }

  /// Both readers say the same.
  void expect_refused(const std::string& name, const std::string& why) const {
    const std::string file = folder_ + "/" + name;
    EXPECT_EQ(refusal([&] { ConfigNode::load(file); }), file + ": " + why);
    EXPECT_EQ(refusal([&] { extended_files(file); }), file + ": " + why);
  }

  const std::string folder_ =
      (std::filesystem::temp_directory_path() / ("missing_file_" + std::to_string(getpid())))
          .string();

 private:
  template <typename Read>
  static std::string refusal(Read read) {
    try {
      read();
    } catch (const BadInput& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(MissingFile, IsNotCalledUnreadable) {
  expect_refused("settings.yaml", "no such file");
  expect_refused("nowhere/model_I.yaml", "no such file");
  expect_refused("control.yaml/model_I.yaml", "no such file");
  EXPECT_THROW(ConfigNode::load(""), BadInput);
  EXPECT_THROW(extended_files(""), BadInput);
}

TEST_F(MissingFile, OfAModelNamesTheOthersOfItsFolder) {
  expect_refused("model_model_II.yaml.yaml", "no such file; its folder has the models I, II");
}

TEST_F(MissingFile, MayBeAFolder) {
  std::filesystem::create_directories(folder_ + "/model_III.yaml");
  expect_refused("model_III.yaml", "expected a YAML file, not a folder");
}

}  // namespace
}  // namespace anthrob
