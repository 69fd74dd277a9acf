#include "link/slope.h"

#include <gtest/gtest.h>

#include <cmath>

namespace anthrob {
namespace driver {
namespace {

TEST(Slope, IsThatOfALine) {
  Slope slope;
  EXPECT_TRUE(std::isnan(slope.rate()));
  slope.add(1e6, 2.0);
  EXPECT_TRUE(std::isnan(slope.rate()));
  for (int i = 1; i < 20; ++i) {
    slope.add(1e6 + 0.01 * i, 2.0 - 0.7 * 0.01 * i);
    EXPECT_NEAR(slope.rate(), -0.7, 1e-6) << i;
  }
}

TEST(Slope, OfCountsIsGoodToACentiradianASecond) {
  constexpr double kCount = 1.28e-3;
  Slope slope;
  double squares = 0.0;
  for (int i = 0; i < 1000; ++i) {
    slope.add(0.01 * i, kCount * std::round(0.2 * 0.01 * i / kCount));
    if (i >= 6) squares += std::pow(slope.rate() - 0.2, 2) / 994.0;
  }
  EXPECT_LT(std::sqrt(squares), 0.01);
}

TEST(Slope, BeginsAnewAfterAGap) {
  Slope slope;
  for (int i = 0; i < 6; ++i) slope.add(0.01 * i, 0.01 * i);
  slope.add(0.2, 5.0);
  EXPECT_TRUE(std::isnan(slope.rate()));
  slope.add(0.21, 5.0);
  EXPECT_EQ(slope.rate(), 0.0);
  slope.add(0.21, 7.0);  // twice the same instant
  EXPECT_TRUE(std::isnan(slope.rate()));
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
