// How far apart a simulated run and its recording are.
#include "problem/run_differences.h"

#include <gtest/gtest.h>

#include <numeric>

namespace anthrob {
namespace calibration {
namespace {

TEST(RunDifferences, AreMeansOfSquares) {
  Differences d;
  d.joints = 2;
  d.posture.resize(2, 4);
  d.posture << 0.3, 0.0, 0.4, 0.1, 0.0, 0.0, 0.0, -0.1;
  d.force.resize(2, 2);
  d.force << 1.0, -3.0, 0.0, 2.0;
  EXPECT_NEAR(d.posture_square(), (0.25 + 0.01 + 0.01) / 4.0, 1e-15);
  EXPECT_NEAR(d.force_square(), 14.0 / 4.0, 1e-15);
  Weights w;
  EXPECT_NEAR(d.fitness(w), 0.0675 + 1e-4 * 3.5, 1e-15);
  RunDifferences run{{}, {}, d};
  EXPECT_DOUBLE_EQ(run.fitness(w), d.fitness(w));
  run.path = d;
  run.before = d;
  run.before.posture *= 2.0;
  w.before = 2.0;
  EXPECT_NEAR(run.fitness(w), (2.0 * run.before.fitness(w) + 2.0 * d.fitness(w)) / 4.0, 1e-15);
  std::vector<double> r;
  run.append_residuals(w, 0.5, r);
  EXPECT_NEAR(std::inner_product(r.begin(), r.end(), r.begin(), 0.0), 0.5 * run.fitness(w), 1e-15);
}

TEST(RunDifferences, BallJointsByAngularDistance) {
  SkeletonModel skeleton;
  JointModel ball;
  ball.type = JointType::kBall;
  skeleton.joints = {ball};
  const Quat a(Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()));
  const Quat b = a * Quat(Eigen::AngleAxisd(3.0, Vec3::UnitY()));
  const double from[] = {a.w(), a.x(), a.y(), a.z()};
  const double to[] = {-b.w(), -b.x(), -b.y(), -b.z()};
  double row[3];
  posture_row(skeleton, from, to, row);
  EXPECT_NEAR(row[0], 0.0, 1e-12);
  EXPECT_NEAR(row[1], 3.0, 1e-12);
  posture_row(skeleton, from, from, row);
  EXPECT_EQ(Vec3(row[0], row[1], row[2]).norm(), 0.0);
}

}  // namespace
}  // namespace calibration
}  // namespace anthrob
