// anthrob_compare on recordings as a user has them.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "anthrob_recording/bag.h"

namespace anthrob {
namespace {

class CompareTool : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        (std::filesystem::temp_directory_path() / ("anthrob_compare_" + std::to_string(getpid())))
            .string();
    std::filesystem::create_directories(folder_);
    Dataset data;
    data.meta.robot = "rig";
    data.table("joints").t = {0, 5000000, 10000000};
    data.table("joints").columns = {{"hinge/position", {0.25, 0.5, 0.5}, {1, 1, 1}},
                                    {"hinge/velocity", {0.0, 0.0, 0.0}, {1, 1, 1}}};
    data.save(folder_ + "/a");
    data.table("joints").columns[0].values = {0.25, 0.5, 0.8};
    write_bag(data, folder_ + "/b.bag");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  int run(const std::string& arguments) const {
    const std::string command =
        "cd " + folder_ + " && " ANTHROB_COMPARE " " + arguments + " >said.txt 2>errors.txt";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string content(const std::string& file) const {
    std::ifstream in(folder_ + "/" + file);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  std::string folder_;
};

TEST_F(CompareTool, PrintsAndDrawsADatasetAndABag) {
  ASSERT_EQ(run("a b.bag --channel position --out figure.svg"), 0) << content("errors.txt");
  EXPECT_EQ(content("errors.txt"), "");
  EXPECT_EQ(content("said.txt"),
            "channel                  rms       largest     at [s]   samples  unit\n"
            "hinge/position       0.17321           0.3      0.010         3  rad or m\n"
            "wrote figure.svg\n");
  const std::string figure = content("figure.svg");
  EXPECT_NE(figure.find("hinge/position [rad or m]"), std::string::npos);
  EXPECT_NE(figure.find("dash"), std::string::npos);
}

TEST_F(CompareTool, RefusesWhatItCannotCompare) {
  EXPECT_EQ(run("a nowhere"), 2);
  EXPECT_EQ(run("a b.bag --channel elbow"), 2);
  EXPECT_EQ(content("errors.txt"),
            "anthrob_compare: --channel elbow: not in both recordings; expected NAME/QUANTITY, a "
            "NAME or a QUANTITY\n");
  EXPECT_EQ(run("a b.bag --out figure.png"), 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ + "/figure.png"));
}

}  // namespace
}  // namespace anthrob
