#include "orbit_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_core/testing/random.h"

namespace anthrob {
namespace {

constexpr double kOpening = 0.8, kAspect = 1.5;

/// Of a point in the picture, from -1 to 1 each: by a camera whose axes come from rotations.
Eigen::Vector2d in_picture(const OrbitView& view, double yaw, double pitch, const Vec3& point) {
  const Mat3 turn =
      (Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * Eigen::AngleAxisd(-pitch, Vec3::UnitY()))
          .toRotationMatrix();
  const Vec3 eye = view.focus + view.distance * turn.col(0);
  const Vec3 seen = turn.transpose() * (point - eye);  // along -x, y to the right, z upwards
  const double half = -seen.x() * std::tan(0.5 * kOpening);
  return {seen.y() / (half * kAspect), seen.z() / half};
}

TEST(OrbitView, AllOfABoxIsInThePictureAndFillsIt) {
  testing_support::Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Vec3 middle = random.vector(2.0), half = random.vector(1.0).cwiseAbs();
    const Box box{middle - half, middle + half};
    const double yaw = random.uniform(-3.0, 3.0), pitch = random.uniform(-1.4, 1.4);
    const OrbitView view = fitting_view(box, yaw, pitch, kOpening, kAspect);
    double farthest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 at(corner & 1 ? box.high.x() : box.low.x(),
                    corner & 2 ? box.high.y() : box.low.y(),
                    corner & 4 ? box.high.z() : box.low.z());
      const Eigen::Vector2d seen = in_picture(view, yaw, pitch, at);
      ASSERT_LT(seen.cwiseAbs().maxCoeff(), 1.0) << i;
      farthest = std::max(farthest, seen.cwiseAbs().maxCoeff());
    }
    ASSERT_GT(farthest, 0.85) << i;
  }
}

TEST(OrbitView, ABoxOfNoSizeIsSeenFromItself) {
  const Vec3 at(1.0, 2.0, 3.0);
  const OrbitView view = fitting_view({at, at}, 0.3, 0.2, kOpening, kAspect);
  EXPECT_EQ(view.focus, at);
  EXPECT_EQ(view.distance, 0.0);
}

}  // namespace
}  // namespace anthrob
