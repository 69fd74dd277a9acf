#include "ros2/ros2_bag.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "anthrob_core/errors.h"
#include "anthrob_recording/bag.h"
#include "ros2/cdr_bytes.h"
#include "ros2/db3.h"

namespace anthrob {
namespace {

const char kJointState[] = "sensor_msgs/msg/JointState";

std::string joint_state(int i) {
  return CdrBytes(i % 2 == 0)
      .header(100, static_cast<std::uint32_t>(10000000 * i), "")
      .texts({"hinge"})
      .numbers({0.1 * i})
      .numbers({})
      .numbers({1.0 - i})
      .all();
}

class Ros2Bag : public ::testing::Test {
 protected:
  Ros2Bag()
      : folder_(std::filesystem::temp_directory_path() /
                ("anthrob_ros2_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Ros2Bag() override { std::filesystem::remove_all(folder_); }
  std::string operator/(const std::string& name) const { return (folder_ / name).string(); }

  /// Ten joint states from 100 s on, two of them of a second topic's.
  void write_small(const std::string& file, int first = 0, int end = 10) {
    Db3 db(file);
    db.topic(1, "/rig/joint_states", kJointState);
    db.topic(2, "/rosout", "rcl_interfaces/msg/Log");
    for (int i = first; i < end; ++i) {
      db.message(1, 100000000777 + i * std::int64_t{10000000}, joint_state(i));
    }
    db.message(2, 100000000000, "whatever");
  }
  std::string error(const std::string& path) {
    try {
      load_recording(path);
    } catch (const BadInput& bad) {
      return bad.what();
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

TEST_F(Ros2Bag, AFileIsReadAsABagOfRos1Is) {
  write_small(*this / "run.db3");
  std::vector<std::string> not_carried;
  const Dataset data = read_ros2_bag(*this / "run.db3", &not_carried);
  EXPECT_EQ(data.meta.robot, "rig");
  EXPECT_EQ(not_carried, std::vector<std::string>{"/rosout (1 messages)"});
  ASSERT_EQ(data.tables.size(), 1u);
  EXPECT_EQ(data.tables[0].name, "joints");
  EXPECT_EQ(data.tables[0].t[3], 100030000000);
  EXPECT_EQ(data.tables[0].bag_time[3], 100030000777);
  EXPECT_TRUE(data.tables[0].stamp.empty());
  ASSERT_EQ(data.series("hinge/effort").values.size(), 10u);
  EXPECT_EQ(data.series("hinge/position").values[7], 0.1 * 7);
  EXPECT_EQ(data.series("hinge/effort").values[7], -6.0);
  EXPECT_TRUE(data.series("hinge/velocity").empty());
  EXPECT_TRUE(data.remarks.empty());
  // All that read recordings take it.
  EXPECT_EQ(load_recordings(*this / "run.db3").size(), 1u);
  EXPECT_EQ(load_recordings(folder_.string()).size(), 1u);
}

TEST_F(Ros2Bag, AFolderMayHaveSeveralFilesAndADescription) {
  std::filesystem::create_directories(*this / "run");
  write_small(*this / "run/run_0.db3", 0, 5);
  write_small(*this / "run/run_1.db3", 5, 10);
  std::ofstream(*this / "run/metadata.yaml")
      << "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n"
         "  relative_file_paths:\n    - run_0.db3\n    - run/run_1.db3\n"
         "  compression_format: \"\"\n  compression_mode: \"\"\n";
  std::ofstream(*this / "run/meta.yaml") << "kind: trajectory\nstart: {settle_s: 2}\n";
  const Dataset data = load_recording(*this / "run");
  EXPECT_EQ(data.series("hinge/position").values.size(), 10u);
  EXPECT_EQ(data.meta.settle_s, 2.0);
  EXPECT_EQ(data.meta.robot, "rig");
}

TEST_F(Ros2Bag, WhatCannotBeReadIsSaidInOneLine) {
  const auto expect = [&](const std::string& path, const std::string& said) {
    EXPECT_NE(error(path).find(said), std::string::npos) << error(path);
    EXPECT_EQ(error(path).find('\n'), std::string::npos);
  };
  std::filesystem::create_directories(*this / "mcap");
  std::ofstream(*this / "mcap/metadata.yaml")
      << "rosbag2_bagfile_information: {storage_identifier: mcap, relative_file_paths: [a.mcap]}\n";
  expect(*this / "mcap", "storage_identifier: mcap: expected sqlite3");
  std::filesystem::create_directories(*this / "zstd");
  std::ofstream(*this / "zstd/metadata.yaml")
      << "rosbag2_bagfile_information: {storage_identifier: sqlite3, compression_format: zstd, "
         "relative_file_paths: [a.db3.zstd]}\n";
  expect(*this / "zstd", "compression_format: zstd: expected a bag without compression");
  std::ofstream(*this / "text.db3") << std::string(5000, 'x');
  expect(*this / "text.db3", "text.db3: cannot be read as a database of SQLite: file is not a");
  expect(*this / "nowhere.db3", "nowhere.db3: no such recording");
  {
    Db3 db(*this / "view.db3");
    db.run("DROP TABLE messages; CREATE VIEW messages AS SELECT 1");
  }
  expect(*this / "view.db3", "has no table 'messages'; expected a bag of ROS 2");
  {
    Db3 db(*this / "other.db3");
    db.topic(1, "/tf", "tf2_msgs/msg/TFMessage");
  }
  expect(*this / "other.db3", "contains no topic of a recording");
  {
    Db3 db(*this / "type.db3");
    db.topic(1, "/joint_states", "std_msgs/msg/String");
  }
  expect(*this / "type.db3", "topic /joint_states is std_msgs/msg/String: expected sensor_msgs/");
  {
    Db3 db(*this / "format.db3");
    db.topic(1, "/joint_states", kJointState, "protobuf");
  }
  expect(*this / "format.db3", "serialised as protobuf: expected cdr");
  {
    Db3 db(*this / "name.db3");
    db.topic(1, "/joint\nstates", kJointState);
  }
  expect(*this / "name.db3", "a name or a type that ROS 2 does not allow");
  {
    Db3 db(*this / "none.db3");
    db.topic(1, "/joint_states", kJointState);
  }
  expect(*this / "none.db3", "its topics hold no messages");
  {
    Db3 db(*this / "cut.db3");
    db.topic(1, "/joint_states", kJointState);
    db.message(1, 5, joint_state(0).substr(0, 50));
  }
  expect(*this / "cut.db3", "topic /joint_states: message 1: ");
  {
    Db3 db(*this / "word.db3");
    db.topic(1, "/joint_states", kJointState);
    db.run("INSERT INTO messages VALUES(1, 1, 1, 'text')");
  }
  expect(*this / "word.db3", "data in a row of its tables: expected bytes");
}

TEST_F(Ros2Bag, DamagedFilesAreReadOrRefused) {
  write_small(*this / "run.db3");
  std::ifstream in(*this / "run.db3", std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  int refused = 0, tried = 0;
  for (std::size_t at = 0; at < whole.size(); at += 211) {
    for (const char value : {'\0', '\xff'}) {
      std::string bytes = whole;
      bytes[at] = value;
      std::ofstream(*this / "bad.db3", std::ios::binary) << bytes;
      const std::string said = error(*this / "bad.db3");
      refused += said != "no error";
      ++tried;
      EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_LT(refused, tried);
  std::ofstream(*this / "short.db3", std::ios::binary) << whole.substr(0, whole.size() / 2);
  EXPECT_NE(error(*this / "short.db3"), "no error");
}

}  // namespace
}  // namespace anthrob
