// A tendon through the middle of a surface: told, and nothing else is.
#include "path/undecided_side.h"

#include <gtest/gtest.h>

#include <cmath>

#include "path/cylinder.h"
#include "path/sphere.h"

namespace anthrob {
namespace {

std::shared_ptr<const WrappingSurface> cylinder(const std::string& more = "") {
  return Cylinder::load(
      ConfigNode::parse("{origin: [0, 0, 0], axis: [0, 1, 0], radius: 0.02" + more + "}", "test"),
      Pose());
}

std::shared_ptr<const WrappingSurface> sphere() {
  return Sphere::load(ConfigNode::parse("{center: [0, 0, 0], radius: 0.02}", "test"), Pose());
}

const Vec3 kAbove(0.0, 0.0, 0.1);

// By hand: two tangents and the arc between them.
double over_the_middle(double l1, double l2, double r) {
  return std::sqrt(l1 * l1 - r * r) + std::sqrt(l2 * l2 - r * r) +
         r * (M_PI - std::acos(r / l1) - std::acos(r / l2));
}

TEST(UndecidedSide, ThroughTheAxisOfACylinder) {
  const auto lengths = undecided_side(*cylinder(), kAbove, {0.0, 0.0, -0.15});
  ASSERT_TRUE(lengths);
  EXPECT_NEAR(lengths->first, over_the_middle(0.1, 0.15, 0.02), 1e-6);
  EXPECT_NEAR(lengths->second, lengths->first, 1e-6);
  EXPECT_TRUE(undecided_side(*cylinder(), kAbove, {1e-9, 0.0, -0.15}));
  // Along the axis it may be displaced as far as one likes.
  EXPECT_TRUE(undecided_side(*cylinder(), kAbove, {0.0, 0.05, -0.15}));
}

TEST(UndecidedSide, ThroughTheCentreOfASphere) {
  const auto lengths = undecided_side(*sphere(), kAbove, {0.0, 0.0, -0.15});
  ASSERT_TRUE(lengths);
  EXPECT_NEAR(lengths->first, over_the_middle(0.1, 0.15, 0.02), 1e-6);
  EXPECT_TRUE(undecided_side(*sphere(), {0.06, 0.0, 0.08}, {-0.06, 1e-10, -0.08}));
}

// The long way round is another length.
TEST(UndecidedSide, WoundRoundTheLongWay) {
  EXPECT_TRUE(undecided_side(*cylinder(", start: negative"), kAbove, {0.0, 0.0, -0.15}));
}

TEST(UndecidedSide, DecidedByThePoints) {
  for (const double x : {1e-4, 0.001, 0.01, 0.019999999, 0.02, 0.020000001, 0.03}) {
    EXPECT_FALSE(undecided_side(*cylinder(), {x, 0.0, 0.1}, {x, 0.0, -0.15})) << x;
    EXPECT_FALSE(undecided_side(*sphere(), {x, 0.0, 0.1}, {x, 0.0, -0.15})) << x;
  }
  // Both on one side of it: clear.
  EXPECT_FALSE(undecided_side(*cylinder(), kAbove, {0.0, 0.0, 0.05}));
}

}  // namespace
}  // namespace anthrob
