// Sensors that count.
#include "measurement/counts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "config.h"

namespace anthrob {
namespace discovery {
namespace {

constexpr double kEncoder = 2.0 * M_PI / 4096.0, kConverter = 0.25;  // [rad, N]

double rounded(double value, double count) {
  return count > 0.0 ? count * std::round(value / count) : value;
}

/// Positions of both muscles of the rig, and the flexor's force.
Description counted(const RobotModel& robot, double flexor, double extensor) {
  Dataset data;
  data.folder = "run";
  Table& table = data.table("muscles");
  for (const char* name : {"flexor/position", "extensor/position", "flexor/force"}) {
    table.column(name);
  }
  for (int i = 0; i < 4000; ++i) {
    const double t = 0.005 * i;
    table.t.push_back(static_cast<Nanoseconds>(i) * 5000000);
    const double values[] = {rounded(std::sin(1.7 * t), flexor),
                             rounded(std::cos(1.3 * t), extensor),
                             rounded(20.0 + 10.0 * std::sin(t), kConverter)};
    for (std::size_t k = 0; k < 3; ++k) {
      table.columns[k].values.push_back(values[k]), table.columns[k].present.push_back(1);
    }
  }
  Description description;
  description.question.train = {data};
  report_counts(robot, description);
  return description;
}

RobotModel counted_rig() {
  return *load_robot_model(kConfig + "/two_muscle_rig/model_I.yaml");
}

TEST(Counts, AreToldOfAKindOrOfItsPlaces) {
  const Description both = counted(counted_rig(), kEncoder, kEncoder);
  ASSERT_EQ(both.measurement.size(), 2u);
  EXPECT_EQ(both.measurement[0].place, "all");
  EXPECT_EQ(both.measurement[0].channel_kind, "position");
  EXPECT_EQ(both.measurement[0].what, "count");
  EXPECT_NEAR(both.measurement[0].value, kEncoder, 1e-9);
  EXPECT_EQ(both.measurement[1].place, "flexor");  // the only force
  EXPECT_NEAR(both.measurement[1].value, kConverter, 1e-9);
  const Description one = counted(counted_rig(), 0.0, kEncoder);
  EXPECT_EQ(one.measurement[0].place, "extensor");
  EXPECT_EQ(one.remarks[0].find("extensor/position: in steps of 0.00153 rad"), 0u)
      << one.remarks[0];
  EXPECT_FALSE(one.corrected);
}

TEST(Counts, OfTheModelsSensorsAreNoNews) {
  RobotModel robot = counted_rig();
  robot.sensors.position.quantum = kEncoder;
  robot.sensors.force.quantum = kConverter;
  EXPECT_TRUE(counted(robot, kEncoder, kEncoder).measurement.empty());
  EXPECT_EQ(counted(robot, 2.0 * kEncoder, 2.0 * kEncoder).measurement.size(), 1u);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
