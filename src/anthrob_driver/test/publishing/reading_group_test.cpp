#include "publishing/reading_group.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace driver {
namespace {

using Sensors = std::vector<std::size_t>;

/// @return which sensors are handed out when this reading comes
Sensors add(ReadingGroup& group, double time, std::size_t sensor) {
  AnalogSample reading;
  reading.time = time;
  reading.sensor = sensor;
  Sensors out;
  for (const AnalogSample& sample : group.add(reading)) out.push_back(sample.sensor);
  return out;
}

TEST(ReadingGroup, ASingleSensorWaitsForNobody) {
  ReadingGroup group(1);
  EXPECT_EQ(add(group, 0.0, 0), Sensors({0}));
  EXPECT_EQ(add(group, 0.01, 0), Sensors({0}));
}

TEST(ReadingGroup, SensorsOfOneInstantGoTogetherInTheirOrder) {
  ReadingGroup group(3);
  for (const double time : {0.0, 0.01}) {
    EXPECT_EQ(add(group, time, 2), Sensors());
    EXPECT_EQ(add(group, time, 0), Sensors());
    EXPECT_EQ(add(group, time, 1), Sensors({0, 1, 2}));
  }
}

TEST(ReadingGroup, WhatOneSensorDidNotAnswerGoesWithoutIt) {
  ReadingGroup group(3);
  add(group, 0.0, 2), add(group, 0.0, 0);
  EXPECT_EQ(add(group, 0.01, 0), Sensors({0, 2}));
  EXPECT_EQ(add(group, 0.01, 1), Sensors());
  EXPECT_EQ(add(group, 0.01, 2), Sensors({0, 1, 2}));
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
