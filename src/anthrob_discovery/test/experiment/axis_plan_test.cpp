#include "experiment/axis_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "driven_bench.h"
#include "experiment/axis_motion.h"

namespace anthrob {
namespace discovery {
namespace {

AxisPlan plan(const DrivenBench& bench) {
  return plan_axes(*load_robot_model(bench.model()), {bench.record(1)}, {});
}

TEST(AxisPlan, InertiaIsHiddenWhereEffortHardlyDependsOnAcceleration) {
  DrivenBench bench;
  bench.inertia = 1e-4;
  bench.coulomb = 0.1;
  EXPECT_EQ(plan(bench).hidden_inertia, std::vector<int>{0});
  bench.inertia = 0.1;
  EXPECT_TRUE(plan(bench).hidden_inertia.empty());
}

TEST(AxisPlan, BinsAreLongerForCoarseEncodersAndNoShorterThanARow) {
  DrivenBench bench;
  bench.inertia = 0.05;
  bench.rate = 1000.0;
  bench.bits = 20;
  const double fine = plan(bench).bin;
  bench.bits = 12;
  const double coarse = plan(bench).bin;
  EXPECT_GT(coarse, 1.5 * fine);
  EXPECT_LE(coarse, 0.2);
  bench.rate = 25.0;
  EXPECT_GE(plan(bench).bin, 0.04 - 1e-9);
}

TEST(AxisPlan, BinsAreLongWhereOnlyTheyShowTheInertia) {
  // In short ones, the noise of the acceleration is larger than the acceleration.
  DrivenBench bench;
  bench.inertia = 1e-4;
  bench.viscous = 4e-4;
  bench.noise = 7e-6;
  bench.rate = 600.0;
  bench.bits = 12;
  EXPECT_GT(plan(bench).bin, 0.05);
  EXPECT_TRUE(plan(bench).hidden_inertia.empty());
}

TEST(AxisPlan, BinsAreShortWhereTheEffortAloneScatters) {
  // White noise of the effort tells as much in bins of any length; rest and motion mix in long
  // ones.
  DrivenBench bench;
  bench.inertia = 2e-6;
  bench.viscous = 3e-5;
  bench.coulomb = 3e-3;
  bench.noise = 3e-4;
  bench.rate = 25.0;
  EXPECT_LT(plan(bench).bin, 0.1);
  bench.rate = 500.0;
  EXPECT_LT(plan(bench).bin, 0.05);
}

TEST(AxisMotion, FollowsACurveAndKnowsRest) {
  DrivenBench bench;
  bench.rate = 1000.0;
  bench.bits = 20;
  const Series measured = bench.record(1).series("axis/position");
  const AxisMotion motion(measured, 0.02, 500, {});
  double worst = 0.0, change = 0.0;
  std::size_t moving = 0;
  for (std::size_t b = 0; b < motion.bins(); ++b) {
    const double t = (static_cast<double>(b) + 0.5) * 0.02;
    worst = std::max(worst, std::abs(motion.position(t) - measured.at(t)));
    change += 0.02 * motion.mean_acceleration(b);
    moving += motion.moves(b);
  }
  EXPECT_LT(worst, 2e-4);
  EXPECT_NEAR(change, motion.velocity_at_edge(500) - motion.velocity_at_edge(0), 1e-9);
  EXPECT_FALSE(motion.moves(5));  // it begins at rest
  EXPECT_GT(moving, 250u);
  EXPECT_LT(moving, 450u);
}

/// sin(5 t), 40 rows a second, read off an encoder.
Series swing(double count) {
  Series swing;
  for (int i = 0; i < 400; ++i) {
    const double t = i / 40.0;
    swing.t.push_back(t);
    swing.values.push_back(count * std::round(std::sin(5.0 * t) / count));
  }
  return swing;
}

/// rms error of the speed [rad/s], in bins of 0.2 s
double speed_error(const Series& series) {
  const AxisMotion motion(series, 0.2, 48, {});
  double squares = 0.0;
  for (std::size_t edge = 2; edge < 47; ++edge) {
    const double t = 0.2 * static_cast<double>(edge);
    squares += std::pow(motion.velocity_at_edge(edge) - 5.0 * std::cos(5.0 * t), 2) / 45.0;
  }
  return std::sqrt(squares);
}

TEST(AxisMotion, IsNotFlattenedByFewRowsOfAFineEncoderNorBentByThoseOfACoarseOne) {
  // Of a parabola over 0.2 s: a tenth of the square of half of it times the third derivative.
  const double flattened = 0.1 * 0.1 * 0.1 * 125.0 * std::sqrt(0.5);
  EXPECT_LT(speed_error(swing(1e-5)), 0.1 * flattened);
  EXPECT_NEAR(speed_error(swing(0.1)), flattened, flattened);
  EXPECT_GT(speed_error(swing(0.1)), 0.7 * flattened);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
