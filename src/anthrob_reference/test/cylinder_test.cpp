#include "anthrob_reference/cylinder.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

namespace anthrob::reference {
namespace {

using Eigen::Vector3d;

PlacedCylinder unit_cylinder() {
  return {Vector3d::Zero(), Vector3d::UnitZ(), 1.0};
}

WrapMemory first_contact(const PlacedCylinder& cylinder, const Vector3d& start,
                         const Vector3d& end) {
  return next_contact(cylinder, start, end, WrapMemory{});
}

double length(const PlacedCylinder& cylinder, const Vector3d& start, const Vector3d& end,
              const WrapMemory& memory) {
  return memory.side == 0 ? straight_span(start, end).length
                          : wrapped_span(cylinder, start, end, memory).length;
}

TEST(Cylinder, ArcsOfUnitCylinder) {
  const struct {
    Vector3d start, end;
    double arc;
    int side;
  } cases[] = {{{2.0, 0.9, 0.0}, {-2.0, 1.0, 0.0}, 0.0505974872969326, 1},
               {{2.0, -2.0, 0.0}, {-2.0, 2.1, 0.0}, 0.689036814042993, -1}};
  for (const auto& c : cases) {
    const WrapMemory memory = first_contact(unit_cylinder(), c.start, c.end);
    EXPECT_NEAR(memory.angle, c.arc, 1e-9 * c.arc);
    // Start and end swap places: the same arc the other way round.
    const WrapMemory back = first_contact(unit_cylinder(), c.end, c.start);
    EXPECT_EQ(back.side, -memory.side);
    EXPECT_NEAR(back.angle, c.arc, 1e-9 * c.arc);
  }
}

TEST(Cylinder, QuarterTurnArm) {
  // Bar that turns about the axis of a cylinder; the tendon starts as a tangent and ends on the
  // bar.
  const double radius = 0.5;
  const PlacedCylinder cylinder{Vector3d::Zero(), Vector3d::UnitZ(), radius};
  const Vector3d start(radius, -0.4, 0.0);
  WrapMemory memory;
  for (int k = 1; k <= 90; ++k) {
    const double q = k * M_PI / 180.0;
    const Vector3d end = Eigen::AngleAxisd(q, Vector3d::UnitZ()) * Vector3d(radius, 0.5, 0.0);
    memory = next_contact(cylinder, start, end, memory);
    ASSERT_EQ(memory.side, 1);
    const SpanGeometry span = wrapped_span(cylinder, start, end, memory);
    EXPECT_NEAR(span.length, 0.9 + radius * q, 1e-9);
    EXPECT_NEAR(span.u_end.dot(Vector3d::UnitZ().cross(end)), radius, 1e-9);  // dl/dq
  }
}

TEST(Cylinder, HelixIsAStraightLineUnrolled) {
  const Vector3d start(2.0, 0.0, 0.3);
  const Vector3d end(-1.5, -0.2, 1.7);
  const WrapMemory memory = first_contact(unit_cylinder(), start, end);
  const SpanGeometry span = wrapped_span(unit_cylinder(), start, end, memory);
  const double plane = std::sqrt(3.0) + std::sqrt(1.5 * 1.5 + 0.04 - 1.0) + span.angle;
  EXPECT_NEAR(span.length, std::hypot(plane, 1.4), 1e-12);
  // Constant slope along the axis; tension the same on both sides.
  EXPECT_NEAR(span.u_start.z(), 1.4 / span.length, 1e-12);
  EXPECT_NEAR(span.u_end.z(), 1.4 / span.length, 1e-12);
  EXPECT_NEAR(span.u_start.norm(), 1.0, 1e-12);
  EXPECT_NEAR(span.u_end.norm(), 1.0, 1e-12);
}

TEST(Cylinder, TouchesExactlyWhenTheSegmentCutsTheCircle) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-3.0, 3.0);
  int touching = 0;
  for (int k = 0; k < 20000; ++k) {
    const Vector3d start(uniform(generator), uniform(generator), uniform(generator));
    const Vector3d end(uniform(generator), uniform(generator), uniform(generator));
    if (start.head<2>().norm() < 1.0 || end.head<2>().norm() < 1.0) continue;
    const Eigen::Vector2d d = (end - start).head<2>();
    const double foot = std::clamp(-start.head<2>().dot(d) / d.squaredNorm(), 0.0, 1.0);
    const bool cuts = (start.head<2>() + foot * d).norm() < 1.0;
    EXPECT_EQ(first_contact(unit_cylinder(), start, end).side != 0, cuts);
    touching += cuts;
  }
  EXPECT_GT(touching, 1000);
}

TEST(Cylinder, LengthAndDirectionAreContinuousAtTouchDown) {
  const Vector3d start(2.0, 0.0, 0.0);
  WrapMemory memory;
  SpanGeometry before;
  int changes = 0;
  for (int k = 0; k <= 4000; ++k) {
    const double y = 3.0 - 1e-3 * k;
    const Vector3d end(-2.0, y, 0.5);
    const WrapMemory next = next_contact(unit_cylinder(), start, end, memory);
    const SpanGeometry span = next.side == 0 ? straight_span(start, end)
                                             : wrapped_span(unit_cylinder(), start, end, next);
    if (next.side != memory.side) {
      ++changes;
      EXPECT_NEAR(span.length, before.length, 1e-3);
      EXPECT_NEAR((span.u_start - before.u_start).norm(), 0.0, 1e-3);
      EXPECT_NEAR((span.u_end - before.u_end).norm(), 0.0, 1e-3);
    }
    memory = next;
    before = span;
  }
  EXPECT_EQ(changes, 1);
}

TEST(Cylinder, RemembersSideAndTurnsUntilItLiftsOff) {
  const Vector3d start(1.0, -2.0, 0.0);
  WrapMemory memory;
  const auto turn_to = [&](double q) {
    const Vector3d end = Eigen::AngleAxisd(q, Vector3d::UnitZ()) * Vector3d(1.0, 2.0, 0.0);
    memory = next_contact(unit_cylinder(), start, end, memory);
  };
  for (int k = 1; k <= 1000; ++k) turn_to(0.01 * k);
  EXPECT_EQ(memory.side, 1);
  EXPECT_NEAR(memory.angle, 10.0, 1e-9);  // more than a turn and a half
  for (int k = 999; k >= 1; --k) turn_to(0.01 * k);
  EXPECT_NEAR(memory.angle, 0.01, 1e-9);
  turn_to(-0.01);
  EXPECT_EQ(memory.side, 0);
}

TEST(Cylinder, DirectionsAreGradientsOfTheLength) {
  // Including points that are lifted to the surface from inside.
  const PlacedCylinder cylinder{Vector3d(0.1, 0.2, -0.3), Vector3d(0.2, 1.0, 0.3).normalized(),
                                0.5};
  const Vector3d start(0.9, 0.4, -0.9);
  const Vector3d across = cylinder.axis.cross(start - cylinder.origin);
  for (const double inside : {-0.5, -0.01, 0.001, 0.02}) {
    const Vector3d out = across.cross(cylinder.axis).normalized();
    const Vector3d tilted = Eigen::AngleAxisd(2.5, cylinder.axis) * out;
    const Vector3d end =
        cylinder.origin + (cylinder.radius - inside) * tilted + 0.3 * cylinder.axis;
    const WrapMemory memory = first_contact(cylinder, start, end);
    ASSERT_NE(memory.side, 0);
    const SpanGeometry span = wrapped_span(cylinder, start, end, memory);
    const double h = 1e-6;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d step = h * Vector3d::Unit(axis);
      EXPECT_NEAR((length(cylinder, start, end + step, memory) -
                   length(cylinder, start, end - step, memory)) /
                      (2.0 * h),
                  span.u_end(axis), 1e-8);
      EXPECT_NEAR((length(cylinder, start + step, end, memory) -
                   length(cylinder, start - step, end, memory)) /
                      (2.0 * h),
                  -span.u_start(axis), 1e-8);
    }
  }
}

TEST(Cylinder, MeasuresPenetration) {
  EXPECT_EQ(penetration(unit_cylinder(), {2.0, 0.0, 0.0}, {0.0, 1.0, 5.0}), 0.0);
  EXPECT_NEAR(penetration(unit_cylinder(), {2.0, 0.0, 0.0}, {0.0, 0.75, 5.0}), 0.25, 1e-15);
}

}  // namespace
}  // namespace anthrob::reference
