#include "anthrob_ros/descriptor_watch.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <vector>

namespace anthrob {
namespace {

TEST(Descriptors, AreCounted) {
  const std::size_t before = free_descriptors();
  std::vector<int> more;
  for (int i = 0; i < 10; ++i) more.push_back(::dup(0));
  EXPECT_EQ(free_descriptors(), before - 10);
  for (const int fd : more) ::close(fd);
  EXPECT_EQ(free_descriptors(), before);
}

TEST(Descriptors, AreAsManyAsTheSystemAllowsButNotMoreThanCostTime) {
  rlimit original{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &original), 0);
  rlimit low = original;
  low.rlim_cur = 64;
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &low), 0);
  raise_descriptor_limit();
  rlimit raised{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &raised), 0);
  EXPECT_EQ(raised.rlim_cur, std::min<rlim_t>(original.rlim_max, 8192));
  EXPECT_EQ(raised.rlim_max, original.rlim_max);
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &original), 0);
}

}  // namespace
}  // namespace anthrob
