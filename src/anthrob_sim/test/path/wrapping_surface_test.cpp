// Spheres and cylinders against closed forms, through revolutions, flips, touch-down and lift-off.
#include <gtest/gtest.h>

#include <cmath>

#include "path/cylinder.h"
#include "path/sphere.h"
#include "support.h"
#include "tendon.h"

namespace anthrob {
namespace {

using testing_support::Random;
using testing_support::Tendon;

std::shared_ptr<const Cylinder> cylinder_z(double radius, WrapStart start = WrapStart::kNotWrapping,
                                           int half_turns = 0) {
  Mat3 R;  // columns x, y, z of the cylinder; y, its axis, is world z
  R.col(0) = Vec3::UnitX();
  R.col(1) = Vec3::UnitZ();
  R.col(2) = -Vec3::UnitY();
  return std::make_shared<Cylinder>(Pose{R, Vec3::Zero()}, CircleWrap(radius, start, half_turns));
}

std::shared_ptr<const Sphere> sphere(double radius, WrapStart start = WrapStart::kNotWrapping) {
  return std::make_shared<Sphere>(Vec3::Zero(), CircleWrap(radius, start, 0));
}

TEST(Cylinder, MatchesThirdPartyArcLengths) {
  Tendon tendon(cylinder_z(1.0));
  tendon.start({2, 0.9, 0}, {-2, 1, 0});
  EXPECT_NEAR(tendon.contact().length_on, 0.0505974872969326, 1e-9 * 0.05);
  Tendon other(cylinder_z(1.0));
  other.start({2, -2, 0}, {-2, 2.1, 0});
  EXPECT_NEAR(other.contact().length_on, 0.689036814042993, 1e-9 * 0.69);
}

/// An arm that turns by q about the axis, with the tendon on the surface from q = 0 on.
struct QuarterTurn {
  static constexpr double kRadius = 0.5, kStraight = 0.45;
  static Vec3 fixed() { return {kRadius, -kStraight, 0}; }
  static Vec3 moving(double q) {
    // At q the tendon leaves at angle q, tangentially.
    return kRadius * Vec3(std::cos(q), std::sin(q), 0) +
           kStraight * Vec3(-std::sin(q), std::cos(q), 0);
  }
};

template <class Surface>
void expect_quarter_turn(const std::shared_ptr<Surface>& surface) {
  Tendon tendon(surface);
  tendon.start(QuarterTurn::fixed(), QuarterTurn::moving(0.0));
  for (int i = 1; i <= 90; ++i) {
    const double q = 0.5 * M_PI * i / 90;
    tendon.move(QuarterTurn::fixed(), QuarterTurn::moving(q));
    EXPECT_NEAR(tendon.length(), 0.9 + 0.5 * q, 1e-9);
    EXPECT_NEAR(tendon.contact().wrap_angle, q, 1e-9);
    EXPECT_NEAR(tendon.contact().length_in, QuarterTurn::kStraight, 1e-9);
    // dl/dq of the moving end about the axis.
    const Vec3 p = QuarterTurn::moving(q);
    EXPECT_NEAR(tendon.contact().direction_out.dot(Vec3::UnitZ().cross(p)), 0.5, 1e-9);
  }
}

TEST(Cylinder, QuarterTurnArm) {
  expect_quarter_turn(cylinder_z(0.5));
}
TEST(Sphere, QuarterTurnArm) {
  expect_quarter_turn(sphere(0.5));
}

TEST(Cylinder, HelixIsStraightWhenUnrolled) {
  const double r = 0.7, height = 0.9;
  Tendon tendon(cylinder_z(r));
  const Vec3 p1(2.0, -0.3, 0.0), p2(-1.5, -0.2, height);
  tendon.start(p1, p2);
  ASSERT_TRUE(tendon.contact().touching);
  const double l1 = std::hypot(2.0, 0.3), l2 = std::hypot(1.5, 0.2);
  const double b1 = std::sqrt(l1 * l1 - r * r), b2 = std::sqrt(l2 * l2 - r * r);
  double theta = std::abs(std::atan2(-0.2, -1.5) - std::atan2(-0.3, 2.0));
  if (theta > M_PI) theta = 2 * M_PI - theta;
  const double alpha = theta - std::acos(r / l1) - std::acos(r / l2);
  EXPECT_NEAR(tendon.length(), std::hypot(b1 + r * alpha + b2, height), 1e-12);
  // (4.30), (4.31)
  const double planar = b1 + r * alpha + b2;
  EXPECT_NEAR(tendon.contact().entry.z(), height - (r * alpha + b2) / planar * height, 1e-12);
  EXPECT_NEAR(tendon.contact().exit.z(), height - b2 / planar * height, 1e-12);
  // Tangent points lie on the surface, lines of action across their normals.
  EXPECT_NEAR(tendon.contact().entry.head<2>().norm(), r, 1e-12);
  EXPECT_NEAR((tendon.contact().entry - p1).normalized().dot(tendon.contact().direction_in), 1.0,
              1e-12);
  EXPECT_NEAR((p2 - tendon.contact().exit).normalized().dot(tendon.contact().direction_out), 1.0,
              1e-12);
}

TEST(Cylinder, TurningOfAHelixIsLessThanItsAngle) {
  Tendon tendon(cylinder_z(0.7));
  tendon.start({2.0, -0.3, 0.0}, {-1.5, -0.2, 2.5});
  const WrapContact& c = tendon.contact();
  // A helix of slope s turns its tangent by angle / sqrt(1 + s^2).
  const double slope = c.direction_in.z() / c.direction_in.head<2>().norm();
  EXPECT_NEAR(c.turning, c.wrap_angle / std::sqrt(1.0 + slope * slope), 1e-12);
}

TEST(Cylinder, ThreeRevolutionsAndBack) {
  const double r = 0.3, reach = 1.0;
  Tendon tendon(cylinder_z(r));
  const Vec3 fixed(1.2, 0, 0);
  const auto moving = [&](double q) { return Vec3(reach * std::cos(q), reach * std::sin(q), 0.0); };
  const double phi = std::acos(r / 1.2) + std::acos(r / reach);
  const double straight = std::sqrt(1.2 * 1.2 - r * r) + std::sqrt(reach * reach - r * r);
  tendon.start(fixed, moving(0.1));
  EXPECT_FALSE(tendon.contact().touching);
  const double end = 6.0 * M_PI + 3.0, step = 0.01;
  const auto expect_closed_form = [&](double q) {
    tendon.move(fixed, moving(q));
    if (q > phi) {
      EXPECT_TRUE(tendon.contact().touching);
      EXPECT_NEAR(tendon.length(), straight + r * (q - phi), 1e-11);
      EXPECT_EQ(tendon.contact().half_turns, static_cast<int>((q - phi) / M_PI));
    } else {
      EXPECT_FALSE(tendon.contact().touching);
      EXPECT_NEAR(tendon.length(), (fixed - moving(q)).norm(), 1e-12);
    }
  };
  for (double q = 0.1; q < end; q += step) expect_closed_form(q);
  EXPECT_EQ(tendon.contact().half_turns, 6);
  for (double q = end; q > 0.1; q -= step) expect_closed_form(q);
  EXPECT_FALSE(tendon.contact().touching);
}

TEST(Cylinder, DirectionFlipsAfterLiftOff) {
  // Wrapped on one side, lifted off, then wrapped on the other.
  Tendon tendon(cylinder_z(0.3));
  const Vec3 fixed(1.0, 0, 0);
  const auto moving = [](double q) { return Vec3(std::cos(q), std::sin(q), 0.0); };
  for (double q = 0.5; q < 3.6; q += 0.01) tendon.move(fixed, moving(q));
  EXPECT_TRUE(tendon.contact().touching);
  EXPECT_GT(tendon.contact().entry.y(), 0.0);  // counter-clockwise, beyond half a turn
  for (double q = 3.6; q > -3.0; q -= 0.01) {
    const double before = tendon.length();
    tendon.move(fixed, moving(q));
    EXPECT_LE(std::abs(tendon.length() - before), 0.0101);
  }
  EXPECT_TRUE(tendon.contact().touching);
  EXPECT_LT(tendon.contact().entry.y(), 0.0);
}

TEST(Cylinder, StartStatesOfTheThesis) {
  const Vec3 p1(1, 0.1, 0), p2(-1, 0.1, 0);  // short way: over the top
  Tendon positive(cylinder_z(0.3, WrapStart::kPositive));
  positive.start(p1, p2);
  EXPECT_GT(positive.contact().entry.y(), 0.0);
  Tendon negative(cylinder_z(0.3, WrapStart::kNegative));
  negative.start(p1, p2);
  EXPECT_LT(negative.contact().entry.y(), 0.0);
  EXPECT_GT(negative.length(), positive.length());
  // (4.26): one more full turn on the same side.
  Tendon wound(cylinder_z(0.3, WrapStart::kPositive, 2));
  wound.start(p1, p2);
  EXPECT_NEAR(wound.length() - positive.length(), 2 * M_PI * 0.3, 1e-12);
  EXPECT_EQ(wound.contact().half_turns, 2);
}

TEST(Cylinder, PointsOnAndJustInsideTheSurfaceCountAsOnIt) {
  const double r = 0.0173;
  for (const double l : {r, r - 1.1e-5, r * (1 + 1e-12)}) {
    Tendon tendon(cylinder_z(r));
    const Vec3 p1(0.06, 0.0, 0.0), p2 = l * Vec3(std::cos(2.5), std::sin(2.5), 0);
    tendon.start(p1, p2);
    ASSERT_TRUE(tendon.contact().touching);
    const double expected = std::sqrt(0.06 * 0.06 - r * r) + r * (2.5 - std::acos(r / 0.06));
    EXPECT_NEAR(tendon.length(), expected, 2e-8);
    EXPECT_TRUE(tendon.contact().direction_out.allFinite());
    EXPECT_NEAR(tendon.contact().penetration, std::max(0.0, r - l), 1e-12);
  }
}

TEST(Wrapping, DegenerateInputsStayFinite) {
  const Vec3 cases[][2] = {{{0, 0, 0}, {1, 0, 0}},     {{0, 0, 0}, {0, 0, 0}},
                           {{1, 0, 0}, {1, 0, 0}},     {{1, 0, 0}, {-1, 0, 0}},
                           {{2, 0, 0}, {1, 0, 0}},     {{0, 0, 1}, {0, 0, -1}},
                           {{0.3, 0, 0}, {0.3, 0, 1}}, {{0.1, 0, 0}, {-0.1, 0, 0}}};
  for (const auto& points : cases) {
    for (const std::shared_ptr<const WrappingSurface>& surface :
         std::vector<std::shared_ptr<const WrappingSurface>>{cylinder_z(0.3), sphere(0.3)}) {
      Tendon tendon(surface);
      tendon.start(points[0], points[1]);
      EXPECT_TRUE(std::isfinite(tendon.length())) << surface->type();
      EXPECT_TRUE(tendon.contact().direction_in.allFinite()) << surface->type();
      EXPECT_TRUE(tendon.contact().entry.allFinite()) << surface->type();
      EXPECT_NEAR(tendon.contact().direction_in.norm(), 1.0, 1e-9) << surface->type();
    }
  }
}

/// The pulls are the gradient of the length, and bounded, where points are inside, however deep,
/// and whether the tendon touches or not.
void expect_no_work_of_its_own(bool use_cylinder, unsigned seed) {
  Random random(seed);
  int wrapped = 0, straight = 0;
  const double r = 0.02, h = 1e-7;
  for (int i = 0; i < 20000; ++i) {
    const Pose pose = random.pose(0.1);
    std::shared_ptr<const WrappingSurface> surface;
    const CircleWrap circle(r, WrapStart::kNotWrapping, 0);
    if (use_cylinder) surface = std::make_shared<Cylinder>(pose, circle);
    if (!use_cylinder) surface = std::make_shared<Sphere>(pose.p, circle);
    const auto somewhere = [&](double farthest) {
      return Vec3(pose * (random.uniform(0.05, farthest) * r * random.direction()));
    };
    const Vec3 p = somewhere(0.99), q = somewhere(i % 2 == 0 ? 0.99 : 4.0);
    Tendon tendon(surface);
    const WrapContact contact = tendon.start(p, q);
    ASSERT_GT(contact.penetration, 0.0);
    const Vec3 dp = random.direction(), dq = random.direction();
    const auto length_at = [&](double step) {
      Tendon moved = tendon;
      moved.move(p + step * dp, q + step * dq);
      return moved.length();
    };
    const double back = (tendon.length() - length_at(-h)) / h,
                 ahead = (length_at(h) - tendon.length()) / h;
    const double expected = -contact.pull_in.dot(dp) + contact.pull_out.dot(dq);
    // Between the slopes of both sides: they differ by curvature, and by kinks where both points
    // are equally deep.
    ASSERT_GE(expected, std::min(ahead, back) - 2e-5) << i << " " << contact.touching;
    ASSERT_LE(expected, std::max(ahead, back) + 2e-5) << i << " " << contact.touching;
    // Up to 2 along the way and 2 alpha along the ray.
    ASSERT_LE(contact.pull_in.norm(), 2.0 * std::hypot(1.0, M_PI) + 1e-9);
    ++(contact.touching ? wrapped : straight);
  }
  EXPECT_GT(wrapped, 1000);
  EXPECT_GT(straight, 100);
}

TEST(Cylinder, PointsInsideDoNoWork) {
  expect_no_work_of_its_own(true, 11);
}
TEST(Sphere, PointsInsideDoNoWork) {
  expect_no_work_of_its_own(false, 12);
}

/// A point inside that goes round and round winds no tendon on; the length stays continuous, and
/// its gradient is the pull.
void expect_no_winding_from_inside(const std::shared_ptr<const WrappingSurface>& surface,
                                   double start, double most) {
  const Vec3 fixed(0.1, 0, 0);
  const auto at = [](double distance, double q) {
    return Vec3(distance * std::cos(q), distance * std::sin(q), 0.0);
  };
  Tendon tendon(surface);
  tendon.start(fixed, at(0.03, start));
  for (double q = start; q < most - 0.5; q += 0.01) tendon.move(fixed, at(0.03, q));
  const double outside = most - 0.5;
  for (double d = 0.03; d > 0.010; d -= 1e-4) tendon.move(fixed, at(d, outside));
  const double step = 1e-4;
  double last = tendon.length();
  int reversed = 0;
  for (int i = 1; i < 700000; ++i) {
    const double q = outside + step * i;
    tendon.move(fixed, at(0.010, q));
    const Vec3 way = 0.010 * step * Vec3(-std::sin(q), std::cos(q), 0.0);
    const double growth = tendon.length() - last, pulled = tendon.contact().pull_out.dot(way);
    ASSERT_LE(tendon.contact().wrap_angle, most) << q;
    ASSERT_NEAR(growth, 0.0, 2.1 * 0.010 * step) << q;
    if (std::abs(growth - pulled) > 1e-3 * step * 0.010) ++reversed;
    last = tendon.length();
  }
  // The ridge where both ways round are equally long is met once in each round, and it touches down
  // and lifts off on each side.
  EXPECT_GE(reversed, 10);
  EXPECT_LE(reversed, 3 * 12);
}

TEST(Cylinder, APointInsideWindsNothingOn) {
  expect_no_winding_from_inside(cylinder_z(0.015), 1.0, M_PI);
}
TEST(Cylinder, APointInsideWindsNothingOnToAWoundTendon) {
  expect_no_winding_from_inside(cylinder_z(0.015, WrapStart::kPositive), 3.0, 3.0 * M_PI);
}
TEST(Sphere, APointInsideWindsNothingOn) {
  expect_no_winding_from_inside(sphere(0.015), 1.0, M_PI);
}

/// A point 10 mm from the axis of a surface of 15 mm and one that turns about it at 100 mm.
void expect_smooth_touch_down(const std::shared_ptr<const WrappingSurface>& surface) {
  const double step = 1e-4;
  const Vec3 fixed(0.010, 0, 0);
  const auto moving = [](double q) { return Vec3(0.1 * std::cos(q), 0.1 * std::sin(q), 0.0); };
  const auto arm = [&](const WrapContact& contact, double q) {
    return contact.pull_out.dot(Vec3::UnitZ().cross(moving(q)));
  };
  Tendon tendon(surface);
  tendon.start(fixed, moving(1.3));
  EXPECT_FALSE(tendon.contact().touching);
  EXPECT_NEAR(tendon.contact().penetration, 0.005, 1e-12);
  double length = tendon.length(), last_arm = arm(tendon.contact(), 1.3);
  for (int i = 1; i <= 4000; ++i) {
    const double q = 1.3 + step * i;
    tendon.move(fixed, moving(q));
    const double now = arm(tendon.contact(), q);
    ASSERT_NEAR(tendon.length() - length, 0.5 * step * (now + last_arm), 1e-11) << q;
    ASSERT_NEAR(now, last_arm, 2e-3 * step) << q;
    length = tendon.length(), last_arm = now;
  }
  EXPECT_TRUE(tendon.contact().touching);
  EXPECT_NEAR(tendon.contact().penetration, 0.005, 1e-12);
}

TEST(Cylinder, TouchesDownSmoothlyFromAPointInside) {
  expect_smooth_touch_down(cylinder_z(0.015));
}
TEST(Sphere, TouchesDownSmoothlyFromAPointInside) {
  expect_smooth_touch_down(sphere(0.015));
}

/// The drawn path is the solved path: on the surface, from entry to exit, as long as the arc.
void expect_drawn_as_solved(const std::shared_ptr<const WrappingSurface>& surface, const Vec3& p1,
                            const Vec3& p2) {
  Tendon tendon(surface);
  const WrapContact& contact = tendon.start(p1, p2);
  ASSERT_TRUE(contact.touching);
  std::vector<Vec3> points;
  surface->trace(contact, points);
  EXPECT_LT((points.front() - contact.entry).norm(), 1e-12);
  EXPECT_LT((points.back() - contact.exit).norm(), 1e-12);
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  EXPECT_NEAR(length, contact.length_on, 1e-3 * contact.length_on);
}

TEST(Wrapping, DrawnPathIsTheSolvedPath) {
  for (const WrapStart start : {WrapStart::kPositive, WrapStart::kNegative}) {
    expect_drawn_as_solved(cylinder_z(0.3, start), {1, 0.1, 0.2}, {-1, 0.1, -0.4});
    expect_drawn_as_solved(cylinder_z(0.3, start), {1, -0.1, 0.2}, {-1, -0.1, -0.4});
    expect_drawn_as_solved(sphere(0.3, start), {1, 0.1, 0.05}, {-1, 0.1, 0.0});
  }
}

TEST(Sphere, ThreeRevolutionsAndBackOnAGreatCircle) {
  const double r = 0.3;
  Tendon tendon(sphere(r));
  const Vec3 fixed(1.2, 0, 0);
  const Vec3 u = Vec3::UnitX(), v = Vec3(0, 0.6, 0.8);
  const auto moving = [&](double q) { return Vec3(std::cos(q) * u + std::sin(q) * v); };
  const double phi = std::acos(r / 1.2) + std::acos(r / 1.0);
  const double straight = std::sqrt(1.44 - r * r) + std::sqrt(1.0 - r * r);
  tendon.start(fixed, moving(0.1));
  const double end = 6.0 * M_PI + 3.0;
  for (double q = 0.1; q < end; q += 0.013) {
    tendon.move(fixed, moving(q));
    if (q > phi) {
      EXPECT_NEAR(tendon.length(), straight + r * (q - phi), 1e-9);
    }
  }
  EXPECT_EQ(tendon.contact().half_turns, 6);
  for (double q = end; q > 0.1; q -= 0.013) {
    tendon.move(fixed, moving(q));
    if (q > phi) {
      EXPECT_NEAR(tendon.length(), straight + r * (q - phi), 1e-9);
    }
  }
  EXPECT_FALSE(tendon.contact().touching);
}

/// Smooth random motion of a point outside the surface.
class RandomMotion {
 public:
  RandomMotion(Random& random, double nearest, double farthest)
      : nearest_(nearest), farthest_(farthest), axis_(random.direction()) {
    direction_ = axis_.unitOrthogonal();
    for (int i = 0; i < 3; ++i) {
      rate_[i] = random.uniform(-1.5, 1.5);
      phase_[i] = random.uniform(0.0, 6.28);
    }
  }
  Vec3 at(double t) const {
    const double turn = 2.0 * std::sin(rate_[0] * t + phase_[0]) + rate_[1] * t;
    const double tilt = 0.8 * std::sin(rate_[2] * t + phase_[2]);
    const double size = nearest_ + (farthest_ - nearest_) * (0.5 + 0.5 * std::sin(t + phase_[1]));
    return Eigen::AngleAxisd(turn, axis_) *
           (Eigen::AngleAxisd(tilt, direction_) * (size * direction_ + 0.3 * size * axis_));
  }

 private:
  double nearest_, farthest_;
  Vec3 axis_, direction_;
  double rate_[3], phase_[3];
};

/// Over random sweeps: the length changes by no more than the end points move, and the lines of
/// action are its gradient (so neither length nor force jumps).
void expect_continuous(bool use_cylinder, unsigned seed) {
  Random random(seed);
  int touched = 0, lifted = 0;
  for (int sweep = 0; sweep < 5000; ++sweep) {
    const double r = random.uniform(0.005, 0.05);
    std::shared_ptr<const WrappingSurface> surface;
    const Pose pose = random.pose(0.1);
    if (use_cylinder) {
      surface = std::make_shared<Cylinder>(pose, CircleWrap(r, WrapStart::kNotWrapping, 0));
    } else {
      surface = std::make_shared<Sphere>(pose.p, CircleWrap(r, WrapStart::kNotWrapping, 0));
    }
    const RandomMotion one(random, 1.3 * r, 5.0 * r), two(random, 1.3 * r, 5.0 * r);
    const auto outside = [&](const Vec3& p) {
      // A point of the motion may come inside a cylinder near its axis: push it out.
      if (!use_cylinder) return Vec3(pose.p + p);
      Vec3 local = p;
      const double l = std::hypot(local.x(), local.z());
      if (l < 1.2 * r) local *= 1.2 * r / std::max(l, 1e-3 * r);
      return Vec3(pose * local);
    };
    Tendon tendon(surface);
    Vec3 p1 = outside(one.at(0)), p2 = outside(two.at(0));
    tendon.start(p1, p2);
    for (int i = 1; i <= 300; ++i) {
      const double t = 3e-4 * i;
      const Vec3 n1 = outside(one.at(t)), n2 = outside(two.at(t));
      const WrapContact before = tendon.contact();
      const double length = tendon.length();
      const WrapContact& after = tendon.move(n1, n2);
      const double moved = (n1 - p1).norm() + (n2 - p2).norm();
      ASSERT_LE(std::abs(tendon.length() - length), moved * (1 + 1e-9) + 1e-12)
          << "sweep " << sweep << " step " << i;
      // Mean of the gradients before and after; third-order error unless contact changes within the
      // step.
      const double predicted = -0.5 * (before.direction_in + after.direction_in).dot(n1 - p1) +
                               0.5 * (before.direction_out + after.direction_out).dot(n2 - p2);
      const double curvature = moved * moved / r;
      ASSERT_NEAR(tendon.length() - length, predicted, 2.0 * curvature)
          << "sweep " << sweep << " step " << i;
      touched += !before.touching && after.touching;
      lifted += before.touching && !after.touching;
      p1 = n1, p2 = n2;
    }
  }
  // The sweeps must have exercised what they are for.
  EXPECT_GT(touched, 20);
  EXPECT_GT(lifted, 20);
}

TEST(Cylinder, RandomSweepsAreContinuous) {
  expect_continuous(true, 1);
}
TEST(Sphere, RandomSweepsAreContinuous) {
  expect_continuous(false, 2);
}

}  // namespace
}  // namespace anthrob
