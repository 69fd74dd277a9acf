// Least squares with errors by blocks.
#include "health/block_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_core/random.h"

namespace anthrob {
namespace health {
namespace {

TEST(BlockFit, FindsALineAndHowWellItIsKnown) {
  double squares = 0.0, sigma = 0.0;
  const int repeats = 60;
  for (int r = 0; r < repeats; ++r) {
    const CounterRandom random(static_cast<std::uint64_t>(r), 1);
    BlockFit fit(2, 8);
    for (int i = 0; i < 800; ++i) {
      const double x = std::sin(0.05 * i);
      fit.add(i / 100, Eigen::Vector2d(1.0, x),
              2.0 - 3.0 * x + 0.5 * random.normal(static_cast<std::uint64_t>(i)));
    }
    const auto slope = fit.coefficient(1);
    ASSERT_TRUE(slope);
    squares += std::pow(slope->value + 3.0, 2) / repeats, sigma += slope->sigma / repeats;
  }
  // sigma / sqrt(sum of x^2) by the textbook.
  EXPECT_NEAR(std::sqrt(squares), 0.5 / std::sqrt(400.0), 0.008);
  EXPECT_NEAR(sigma, 0.5 / std::sqrt(400.0), 0.006);
}

TEST(BlockFit, SaysNothingOfWhatIsNotThere) {
  BlockFit same(2, 4);
  for (int i = 0; i < 40; ++i) same.add(i / 10, Eigen::Vector2d(1.0, 2.0), 1.0);
  EXPECT_FALSE(same.coefficient(1));
  BlockFit two(1, 4);
  for (int i = 0; i < 20; ++i) two.add(i / 10, Eigen::VectorXd::Ones(1), i);
  EXPECT_FALSE(two.coefficient(0));
}

}  // namespace
}  // namespace health
}  // namespace anthrob
