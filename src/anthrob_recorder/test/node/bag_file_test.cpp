// A bag on a disk that is full.
#include "bag_file.h"

#include <gtest/gtest.h>
#include <sensor_msgs/JointState.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

namespace anthrob {
namespace {

/// Files may grow to so many bytes, until it goes out of scope.
class DiskOf {
 public:
  explicit DiskOf(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit little{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &little);
  }
  ~DiskOf() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_;
};

std::string file() {
  return (std::filesystem::temp_directory_path() / ("full_" + std::to_string(getpid()) + ".bag"))
      .string();
}

/// Names that cannot be compressed away.
sensor_msgs::JointState message(unsigned i) {
  sensor_msgs::JointState state;
  state.header.stamp = ros::Time(1 + i);
  for (unsigned k = 0; k < 20000; ++k) {
    i = i * 1664525u + 1013904223u;
    state.position.push_back(i);
  }
  return state;
}

TEST(BagFile, AFullDiskIsToldAndEndsNothingElse) {
  {
    const DiskOf full(200000);
    BagFile bag(file(), "/robot/");
    try {
      for (unsigned i = 0; i < 100; ++i) bag.write("joint_states", message(i));
      bag.close();
      ADD_FAILURE() << "nothing thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).find(file() + ": cannot be written: "), 0u)
          << error.what();
    }
  }
  std::filesystem::remove(file());
}

TEST(BagFile, OneThatCannotBeBegunIsToldToo) {
  {
    const DiskOf full(100);
    EXPECT_THROW(BagFile(file(), "/robot/"), std::runtime_error);
  }
  std::filesystem::remove(file());
}

TEST(BagFile, OneThatCannotBeClosedIsLeft) {
  {
    const DiskOf full(200000);
    auto bag = std::make_unique<BagFile>(file(), "/robot/");
    bag->write("joint_states", message(1));
    const DiskOf fuller(100);
    bag.reset();  // throws nothing
  }
  EXPECT_TRUE(std::filesystem::exists(file()));
  std::filesystem::remove(file());
}

}  // namespace
}  // namespace anthrob
