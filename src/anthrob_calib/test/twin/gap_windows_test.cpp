#include "twin/gap_windows.h"

#include <gtest/gtest.h>

#include <cmath>

namespace anthrob {
namespace twin {
namespace {

TEST(GapWindows, LastBlocks) {
  const TwinOptions options;
  GapWindows windows(2, options);
  // Ten blocks of 1, then one of 3; the other series has one bin a block.
  for (int block = 0; block < 11; ++block) {
    for (int bin = 0; bin < options.bins_in_block; ++bin) windows.add(0, block < 10 ? 1.0 : -3.0);
    windows.add(1, 2.0);
    windows.add(1, std::nan(""));
    windows.close_block();
  }
  EXPECT_DOUBLE_EQ(windows.sum(0, 0).squares, 50 * 9.0);
  EXPECT_DOUBLE_EQ(windows.sum(0, 1).squares, 50 * (9.0 + 9 * 1.0));
  EXPECT_DOUBLE_EQ(windows.sum(0, 1).count, 500.0);
  EXPECT_DOUBLE_EQ(windows.sum(0, 2).count, 550.0);
  EXPECT_DOUBLE_EQ(windows.sum(1, 1).count, 10.0);
  EXPECT_DOUBLE_EQ(windows.least(1), 250.0);
  windows.clear();
  EXPECT_DOUBLE_EQ(windows.sum(0, 2).count, 0.0);
}

TEST(GapWindows, ForgetsAfterTheLongest) {
  const TwinOptions options;
  GapWindows windows(1, options);
  for (int block = 0; block < 200; ++block) {
    windows.add(0, block < 100 ? 7.0 : 1.0);
    windows.close_block();
  }
  EXPECT_DOUBLE_EQ(windows.sum(0, 2).squares, 60.0);
}

}  // namespace
}  // namespace twin
}  // namespace anthrob
