#include "anthrob_ecu/fir_filter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace anthrob {
namespace ecu {
namespace {

TEST(FirFilter, OrderZeroPassesThrough) {
  FirFilter<60> filter(0);
  for (double x : {1.0, -2.0, 3.5}) EXPECT_DOUBLE_EQ(filter.step(x), x);
}

TEST(FirFilter, StepResponseIsARampOverTheWindow) {
  FirFilter<60> filter(60);
  for (int i = 0; i < 61; ++i) filter.step(0.0);
  for (int i = 1; i <= 61; ++i) EXPECT_NEAR(filter.step(1.0), i / 61.0, 1e-12);
  EXPECT_NEAR(filter.step(1.0), 1.0, 1e-12);
}

TEST(FirFilter, FirstSamplesAreAveragedNotPadded) {
  FirFilter<60> filter(60);
  EXPECT_DOUBLE_EQ(filter.step(4.0), 4.0);
  EXPECT_DOUBLE_EQ(filter.step(6.0), 5.0);
}

TEST(FirFilter, RemovesItsFundamental) {
  // A sine with exactly one period in the window has mean zero.
  FirFilter<60> filter(60);
  double output = 0.0;
  for (int i = 0; i < 100000; ++i) output = filter.step(std::sin(2 * M_PI * i / 61.0));
  EXPECT_NEAR(output, 0.0, 1e-12);
}

TEST(FirFilter, OrderAboveCapacityIsCapped) {
  FirFilter<4> filter(100);
  for (int i = 0; i < 5; ++i) filter.step(0.0);
  for (int i = 0; i < 4; ++i) filter.step(1.0);
  EXPECT_DOUBLE_EQ(filter.step(1.0), 1.0);
}

}  // namespace
}  // namespace ecu
}  // namespace anthrob
