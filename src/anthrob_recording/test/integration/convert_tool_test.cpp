// anthrob_convert on files of other programs.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "anthrob_recording/bag.h"
#include "ros2/cdr_bytes.h"
#include "ros2/db3.h"

namespace anthrob {
namespace {

class ConvertOtherFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = (std::filesystem::temp_directory_path() /
               ("anthrob_convert_tool_" + std::to_string(getpid())))
                  .string();
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ + "/" + file) << text;
  }
  int run(const std::string& arguments) const {
    const std::string command =
        "cd " + folder_ + " && " ANTHROB_CONVERT " " + arguments + " >said.txt 2>errors.txt";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string content(const std::string& file) const {
    std::ifstream in(folder_ + "/" + file);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  std::string folder_;
};

TEST_F(ConvertOtherFiles, OneFileBecomesSeveralDataSets) {
  std::string rows = "q,u\n";
  for (int i = 0; i < 100; ++i) rows += std::to_string(i) + "," + std::to_string(-i) + "\n";
  write("run.csv", rows);
  const std::string map =
      "robot: r\nrate: 10\ncolumns: [{from: q, to: j/position}, {from: u, to: j/effort}]\n";
  write("map.yaml", map + "split: {train: [0, 4], test: [4, 8], repeat: [8, 60]}\n");
  ASSERT_EQ(run("--columns map.yaml run.csv out"), 0) << content("errors.txt");
  EXPECT_EQ(
      content("said.txt"),
      "wrote out/train: 1 table, 40 rows, 3.900 s\nwrote out/test: 1 table, 40 rows, 3.900 s\n"
      "wrote out/repeat: 1 table, 20 rows, 1.900 s\n");
  EXPECT_EQ(load_recordings(folder_ + "/out").size(), 3u);
  EXPECT_EQ(load_recording(folder_ + "/out/test").series("j/position").values.front(), 40.0);

  // One piece is wrong: nothing is written.
  write("map.yaml", map + "split: {train: [0, 4], test: [40, 80]}\n");
  EXPECT_EQ(run("--columns map.yaml run.csv none"), 2);
  EXPECT_EQ(content("errors.txt").find("anthrob_convert: run.csv: split: test: fewer than two"), 0u)
      << content("errors.txt");
  EXPECT_FALSE(std::filesystem::exists(folder_ + "/none"));
}

TEST_F(ConvertOtherFiles, BagsOfRos2BecomeFoldersAndBags) {
  {
    Db3 db(folder_ + "/rig.db3");
    db.topic(1, "/rig/joint_states", "sensor_msgs/msg/JointState");
    for (std::uint32_t i = 0; i < 3; ++i) {
      db.message(1, 1000000000 + i,
                 CdrBytes(true)
                     .header(1, i, "")
                     .texts({"hinge"})
                     .numbers({0.5 * i})
                     .numbers({})
                     .numbers({})
                     .all());
    }
  }
  ASSERT_EQ(run("rig.db3 rig"), 0) << content("errors.txt");
  ASSERT_EQ(run("rig.db3 rig.bag"), 0) << content("errors.txt");
  for (const char* made : {"/rig", "/rig.bag"}) {
    EXPECT_EQ(load_recording(folder_ + made).series("hinge/position").values,
              (std::vector<double>{0.0, 0.5, 1.0}));
  }
  // rig.yaml is now the description of both: it would be replaced.
  EXPECT_EQ(run("rig.db3 rig.bag"), 2);
  EXPECT_NE(content("errors.txt").find("rig.yaml is an input of this run"), std::string::npos);
}

TEST_F(ConvertOtherFiles, WhatIsNoBagOfRos2IsRefused) {
  write("run.db3", "no database");
  EXPECT_EQ(run("run.db3 out"), 2);
  EXPECT_EQ(content("errors.txt"),
            "anthrob_convert: run.db3: cannot be read as a database of SQLite: file is not a "
            "database\n");
  EXPECT_EQ(run("out run.db3"), 2);
  EXPECT_EQ(run("run.db3 other.db3"), 2);
  EXPECT_NE(content("errors.txt").find("bags of ROS 2 are read only"), std::string::npos);
}

}  // namespace
}  // namespace anthrob
