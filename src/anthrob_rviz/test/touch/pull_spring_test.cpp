#include "touch/pull_spring.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

TEST(PullSpring, PullsTowardsTheMouseAndAgainstTheMotion) {
  const PullSpring spring{200.0, 5.0, 1000.0};
  const Pull pull = pull_of(spring, {1.0, 2.0, 3.0}, {0.0, 0.4, 0.0}, {1.1, 2.0, 2.8});
  EXPECT_NEAR((pull.force_W - Vec3(20.0, -2.0, -40.0)).norm(), 0.0, 1e-12);
  EXPECT_FALSE(pull.limited);
}

TEST(PullSpring, PullsNothingThatIsWhereTheMouseIs) {
  const Pull pull = pull_of({}, {1.0, 2.0, 3.0}, Vec3::Zero(), {1.0, 2.0, 3.0});
  EXPECT_EQ(pull.force_W, Vec3(Vec3::Zero()));
  EXPECT_FALSE(pull.limited);
}

TEST(PullSpring, ALimitKeepsTheDirection) {
  const PullSpring spring{100.0, 0.0, 25.0};
  const Pull pull = pull_of(spring, Vec3::Zero(), Vec3::Zero(), {3.0, 0.0, -4.0});
  EXPECT_NEAR((pull.force_W - Vec3(15.0, 0.0, -20.0)).norm(), 0.0, 1e-12);
  EXPECT_TRUE(pull.limited);
  EXPECT_FALSE(pull_of(spring, Vec3::Zero(), Vec3::Zero(), {0.2499, 0.0, 0.0}).limited);
}

TEST(PullSpring, TheLimitHoldsForTheDamperToo) {
  const Pull pull = pull_of({100.0, 2.0, 30.0}, Vec3::Zero(), {1e3, 0.0, 0.0}, Vec3::Zero());
  EXPECT_NEAR((pull.force_W - Vec3(-30.0, 0.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST(PullSpring, IsSofterWhereItIsRenewedSeldom) {
  const PullSpring spring{100.0, 2.0, 30.0};
  EXPECT_EQ(softened(spring, 0.0).stiffness, 100.0);
  EXPECT_EQ(softened(spring, 0.004).damping, 2.0);
  const PullSpring soft = softened(spring, 0.012);
  EXPECT_NEAR(soft.stiffness, 25.0, 1e-9);
  EXPECT_NEAR(soft.damping, 1.0, 1e-9);
  EXPECT_EQ(soft.limit, 30.0);
}

TEST(RenewalPeriod, IsTheMeanOfTheLast) {
  RenewalPeriod period;
  EXPECT_EQ(period.mean(), 0.0);
  double time = 100.0;  // the first one has none before it
  for (int i = 0; i < 100; ++i) period.renewed(time += 0.01);
  EXPECT_NEAR(period.mean(), 0.01, 1e-5);
  period.renewed(time += 60.0);  // nothing was held
  period.renewed(time -= 5.0);   // time went back
  EXPECT_NEAR(period.mean(), 0.01, 1e-5);
  for (int i = 0; i < 100; ++i) period.renewed(time += 0.004);
  EXPECT_NEAR(period.mean(), 0.004, 1e-5);
}

}  // namespace
}  // namespace anthrob
