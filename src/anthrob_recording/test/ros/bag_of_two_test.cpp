// A bag in which two nodes publish one measurement.
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/JointState.h>
#include <unistd.h>

#include <filesystem>

#include "anthrob_core/errors.h"
#include "anthrob_recording/bag.h"

namespace anthrob {
namespace {

class BagOfTwo : public ::testing::Test {
 protected:
  BagOfTwo()
      : file_(std::filesystem::temp_directory_path() /
              ("anthrob_two_" + std::to_string(getpid()) + ".bag")) {}
  ~BagOfTwo() override { std::filesystem::remove(file_); }

  /// Joint states of these nodes in turn, 4 ms apart.
  void write(const std::vector<std::string>& nodes) {
    rosbag::Bag bag(file_.string(), rosbag::bagmode::Write);
    for (int i = 0; i < 10; ++i) {
      const auto header = boost::make_shared<ros::M_string>();
      (*header)["type"] = ros::message_traits::datatype<sensor_msgs::JointState>();
      (*header)["md5sum"] = ros::message_traits::md5sum<sensor_msgs::JointState>();
      (*header)["message_definition"] = ros::message_traits::definition<sensor_msgs::JointState>();
      (*header)["callerid"] = nodes[static_cast<std::size_t>(i) % nodes.size()];
      sensor_msgs::JointState state;
      state.header.stamp = ros::Time(1.0 + 0.004 * i);
      state.name = {"elbow"};
      state.position = {0.1 * i};
      bag.write("/arm/joint_states", state.header.stamp, state, header);
    }
  }

  std::filesystem::path file_;
};

TEST_F(BagOfTwo, IsRefusedByName) {
  write({"/encoders", "/joint_state_publisher"});
  try {
    read_bag(file_.string());
    FAIL() << "accepted";
  } catch (const BadInput& error) {
    EXPECT_EQ(std::string(error.what()),
              file_.string() +
                  ": /arm/joint_states: two nodes publish elbow: /joint_state_publisher and "
                  "/encoders; expected one publisher of each measurement");
  }
  write({"/encoders"});
  EXPECT_EQ(read_bag(file_.string()).dataset.tables.front().t.size(), 10u);
}

}  // namespace
}  // namespace anthrob
