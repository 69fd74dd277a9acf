#include "publishing/measurement_age.h"

#include <gtest/gtest.h>

#include <cmath>

namespace anthrob {
namespace driver {
namespace {

TEST(MeasurementAge, IsSinceTheWireAsTheKernelSays) {
  EXPECT_EQ(measurement_age(0.003, 0.0028), 0.0028);
  EXPECT_EQ(measurement_age(0.9, 0.899), 0.899);
}

TEST(MeasurementAge, IsSinceSendingWithoutAStamp) {
  EXPECT_EQ(measurement_age(0.003, std::nan("")), 0.003);
}

TEST(MeasurementAge, DoesNotFollowAWallClockThatWasSet) {
  for (const double jump : {-3600.0, -0.7, -0.01, 0.01, 0.7, 3600.0}) {
    EXPECT_EQ(measurement_age(0.003, 0.0028 + jump), 0.003) << jump;
    EXPECT_EQ(measurement_age(0.9, 0.899 + jump), 0.9) << jump;
  }
}

TEST(MeasurementAge, OfOldOnesIsNotForgotten) {
  EXPECT_GT(measurement_age(0.9, 0.899), kOldestMeasurement);
  EXPECT_GT(measurement_age(0.9, std::nan("")), kOldestMeasurement);
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
