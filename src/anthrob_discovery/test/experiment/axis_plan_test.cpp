#include "experiment/axis_plan.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace discovery
}  // namespace anthrob
