#include "ros/scope/bag_source.h"

#include <anthrob_msgs/MuscleStates.h>
#include <anthrob_msgs/SphericalJointStates.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <std_msgs/Float64.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "anthrob_core/errors.h"
#include "anthrob_core/testing/content.h"
#include "anthrob_recording/bag.h"

namespace anthrob {
namespace {

class BagSourceTest : public testing::Test {
 protected:
  BagSourceTest()
      : folder_(std::filesystem::temp_directory_path() /
                ("anthrob_scope_bag_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    bag_ = folder_ / "run.bag";
    write();
  }
  ~BagSourceTest() override { std::filesystem::remove_all(folder_); }

  /// Forces whose decimals have no end, and a topic without a header.
  void write() const {
    rosbag::Bag bag(bag_, rosbag::bagmode::Write);
    for (int i = 0; i < 200; ++i) {
      const ros::Time stamp(1700000000 + i / 100,
                            static_cast<std::uint32_t>(i % 100) * 10000000 + 7);
      anthrob_msgs::MuscleStates states;
      states.header.stamp = stamp;
      states.name = {"flexor", "extensor"};
      states.force = {std::sqrt(2.0 + i), std::exp(-0.1 * i) / 3.0};
      states.position = {0.1 * i, std::nan("")};
      bag.write("/arm/muscle_states", stamp + ros::Duration(0.001), states);
      anthrob_msgs::SphericalJointStates ball;
      ball.header.stamp = stamp;
      ball.name = {"shoulder"};
      ball.orientation.resize(1);
      ball.orientation[0].w = std::cos(0.001 * i), ball.orientation[0].x = std::sin(0.001 * i);
      bag.write("/arm/spherical_joint_states", stamp, ball);
      std_msgs::Float64 gap;
      gap.data = 1.0 / (i + 1.0);
      if (i % 10 == 0) bag.write("/arm/gap", stamp, gap);
    }
  }

  std::filesystem::path folder_, bag_;
};

TEST_F(BagSourceTest, HoldsAllNumbersOfAllTopics) {
  const auto source = open_recording(bag_);
  EXPECT_TRUE(source->remarks().empty());
  EXPECT_EQ(source->begin(), 1700000000000000007);
  const auto loaded = source->load({"/arm/muscle_states/force/extensor", "/arm/gap/data"});
  ASSERT_EQ(loaded.size(), 2U);
  const auto& force = loaded.at("/arm/muscle_states/force/extensor");
  ASSERT_EQ(force.size(), 200U);
  for (int i = 0; i < 200; ++i)
    EXPECT_EQ(force[static_cast<std::size_t>(i)].value, std::exp(-0.1 * i) / 3.0);
  EXPECT_EQ(force[1].t - force[0].t, 10000000) << "the header's stamp, not when it came";
  EXPECT_EQ(loaded.at("/arm/gap/data").size(), 20U);
}

TEST_F(BagSourceTest, ADatasetFolderHasTheSameNamesAndNumbers) {
  Dataset dataset = load_recording(bag_);
  dataset.save(folder_ / "run");
  const auto bag = open_recording(bag_), folder = open_recording(folder_ / "run");
  for (const char* path :
       {"/arm/muscle_states/force/flexor", "/arm/spherical_joint_states/orientation/shoulder/x",
        "/arm/spherical_joint_states/orientation/shoulder/angle"}) {
    const auto a = bag->load({path}).at(path), b = folder->load({path}).at(path);
    ASSERT_EQ(a.size(), 200U) << path;
    ASSERT_EQ(b.size(), 200U) << path;
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].t, b[i].t);
      EXPECT_EQ(a[i].value, b[i].value) << path;
    }
  }
}

TEST_F(BagSourceTest, WhatIsNoBagIsRefusedInOneLine) {
  const auto refusal = [](const std::string& file) -> std::string {
    try {
      open_recording(file);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_EQ(refusal("/nowhere/x.bag").rfind("/nowhere/x.bag: ", 0), 0U);
  std::ofstream(folder_ / "text.bag") << "no bag\n";
  EXPECT_EQ(refusal(folder_ / "text.bag").rfind((folder_ / "text.bag").string() + ": ", 0), 0U);
  std::filesystem::resize_file(bag_, std::filesystem::file_size(bag_) / 2);
  const std::string half = refusal(bag_);
  EXPECT_EQ(half.rfind(bag_.string() + ": ", 0), 0U);
  EXPECT_EQ(half.find('\n'), std::string::npos);
}

/// The program on a machine without ROS master and without a screen.
TEST_F(BagSourceTest, TheProgramExportsExactlyWhatIsInTheBag) {
  const std::string csv = folder_ / "out.csv", errors = folder_ / "errors";
  const std::string command =
      "ROS_MASTER_URI=http://localhost:1 ROS_LOG_DIR=" + folder_.string() + " " ANTHROB_SCOPE " ";
  ASSERT_EQ(std::system((command + bag_.string() + " --plot force --plot gap --export " + csv +
                         " >/dev/null 2>" + errors)
                            .c_str()),
            0)
      << content(errors);
  std::istringstream lines(content(csv));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(
      line,
      "stamp,/arm/gap/data,/arm/muscle_states/force/extensor,/arm/muscle_states/force/flexor");
  const auto expected_gap = [](int i) { return 1.0 / (i + 1.0); };
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(std::getline(lines, line)) << i;
    std::istringstream cells(line);
    std::string stamp, gap, extensor, flexor;
    std::getline(cells, stamp, ','), std::getline(cells, gap, ','),
        std::getline(cells, extensor, ','), std::getline(cells, flexor);
    EXPECT_EQ(stamp,
              time_text(Nanoseconds{1700000000} * 1000000000 + i * Nanoseconds{10000000} + 7));
    EXPECT_EQ(std::strtod(flexor.c_str(), nullptr), std::sqrt(2.0 + i));
    EXPECT_EQ(std::strtod(extensor.c_str(), nullptr), std::exp(-0.1 * i) / 3.0);
    if (i % 10 == 0) {
      EXPECT_EQ(std::strtod(gap.c_str(), nullptr), expected_gap(i));
    } else {
      EXPECT_TRUE(gap.empty());
    }
  }
  EXPECT_FALSE(std::getline(lines, line));
  const int status =
      std::system((command + "/nowhere/x.bag --export " + csv + " 2>" + errors).c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_NE(content(errors).find("/nowhere/x.bag"), std::string::npos) << content(errors);
}

}  // namespace
}  // namespace anthrob
