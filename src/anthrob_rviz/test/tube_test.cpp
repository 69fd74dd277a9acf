#include "tube.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "anthrob_core/testing/random.h"

namespace anthrob {
namespace {

using testing_support::Random;

constexpr double kRadius = 0.002;
constexpr int kSides = 12;

double distance_to_line(const Vec3& p, const Vec3& a, const Vec3& b) {
  return (p - a).cross((b - a).normalized()).norm();
}

/// By the divergence theorem; positive if the triangles are seen counter-clockwise from outside.
double volume(const TubeMesh& mesh) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3 &a = mesh.positions[mesh.indices[i]], &b = mesh.positions[mesh.indices[i + 1]],
               &c = mesh.positions[mesh.indices[i + 2]];
    sum += a.dot(b.cross(c)) / 6.0;
  }
  return sum;
}

Vec3 area_vector(const TubeMesh& mesh) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3& a = mesh.positions[mesh.indices[i]];
    sum += 0.5 *
           (mesh.positions[mesh.indices[i + 1]] - a).cross(mesh.positions[mesh.indices[i + 2]] - a);
  }
  return sum;
}

/// Of the regular polygon that stands for a circle.
double cross_section(double radius, int sides) {
  return 0.5 * sides * radius * radius * std::sin(2.0 * M_PI / sides);
}

void expect_sound(const TubeMesh& mesh) {
  ASSERT_EQ(mesh.positions.size(), mesh.normals.size());
  for (const Vec3& normal : mesh.normals) EXPECT_NEAR(normal.norm(), 1.0, 1e-9);
  for (const Vec3& position : mesh.positions) EXPECT_TRUE(position.allFinite());
  for (const auto i : mesh.indices) ASSERT_LT(i, mesh.positions.size());
  EXPECT_LT(area_vector(mesh).norm(), 1e-12) << "is not closed";
}

TEST(Tube, AStraightOneIsAPrism) {
  const Vec3 a(0.1, 0.2, 0.3), b(0.1, 0.5, 0.7);  // 0.5 m apart
  const TubeMesh mesh = tube({a, b}, kRadius, kSides);
  expect_sound(mesh);
  EXPECT_NEAR(volume(mesh), 0.5 * cross_section(kRadius, kSides), 1e-15);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3& p = mesh.positions[i];
    const double along = (p - a).dot((b - a) / 0.5);
    EXPECT_TRUE(std::abs(along) < 1e-12 || std::abs(along - 0.5) < 1e-12);
    const double distance = distance_to_line(p, a, b);
    EXPECT_TRUE(distance < 1e-12 || std::abs(distance - kRadius) < 1e-12);
  }
}

TEST(Tube, TheMiddlesOfItsEndsAreItsEnds) {
  const std::vector<Vec3> line = {{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.2, 0.05}, {0, 0.2, 0.3}};
  const TubeMesh mesh = tube(line, kRadius, kSides);
  EXPECT_EQ(mesh.positions.front(), line.front());
  EXPECT_NEAR(mesh.normals.front().dot(Vec3::UnitX()), -1.0, 1e-12);
  EXPECT_EQ(mesh.positions.back(), line.back());
  EXPECT_NEAR(mesh.normals.back().dot((line[3] - line[2]).normalized()), 1.0, 1e-12);
}

TEST(Tube, AMitredBendKeepsTheRadiusOfBothPieces) {
  const std::vector<Vec3> line = {{0, 0, 0}, {0.1, 0, 0}, {0.15, 0.1, 0}};
  const TubeMesh mesh = tube(line, kRadius, kSides);
  expect_sound(mesh);
  const Vec3 bisector =
      ((line[1] - line[0]).normalized() + (line[2] - line[1]).normalized()).normalized();
  int on_bend = 0;
  for (const Vec3& p : mesh.positions) {
    if (std::abs((p - line[1]).dot(bisector)) > 1e-12) continue;
    ++on_bend;
    EXPECT_NEAR(distance_to_line(p, line[0], line[1]), kRadius, 1e-12);
    EXPECT_NEAR(distance_to_line(p, line[1], line[2]), kRadius, 1e-12);
  }
  EXPECT_EQ(on_bend, kSides);
  // What one piece lacks on the inner side it has more on the outer.
  const double length = 0.1 + std::sqrt(0.05 * 0.05 + 0.1 * 0.1);
  EXPECT_NEAR(volume(mesh), length * cross_section(kRadius, kSides), 1e-14);
}

TEST(Tube, ARingIsOneOfATorus) {
  std::vector<Vec3> circle;
  for (int i = 0; i <= 200; ++i) {
    const double angle = 1.5 * M_PI * i / 200;
    circle.push_back({0.1 * std::cos(angle), 0.1 * std::sin(angle), 0.0});
  }
  const TubeMesh mesh = tube(circle, 0.01, 48);
  expect_sound(mesh);
  EXPECT_NEAR(volume(mesh), 1.5 * M_PI * 0.1 * M_PI * 0.01 * 0.01, 5e-3 * volume(mesh));
  const Vec3 centre_first = circle.front(), tip = mesh.positions[1];
  EXPECT_NEAR((tip - centre_first).norm(), 0.01, 1e-12);
}

TEST(Tube, PointsInOnePlaceCountOnce) {
  const Vec3 a(0, 0, 0), b(0.1, 0, 0), c(0.1, 0.1, 0);
  const TubeMesh once = tube({a, b, c}, kRadius, kSides);
  const TubeMesh doubled = tube({a, a, b, b, b + Vec3(1e-9, 0, 0), c, c}, kRadius, kSides);
  EXPECT_EQ(once.positions, doubled.positions);
  EXPECT_EQ(once.indices, doubled.indices);
}

TEST(Tube, NothingToDrawIsEmpty) {
  EXPECT_TRUE(tube({}, kRadius, kSides).empty());
  EXPECT_TRUE(tube({Vec3::Zero()}, kRadius, kSides).empty());
  EXPECT_TRUE(tube({Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}, kRadius, kSides).empty());
}

TEST(Tube, ATurnBackHasNoSpike) {
  for (const double turn : {2.2, 3.0, M_PI}) {
    const Vec3 back(std::cos(turn), std::sin(turn), 0.0);
    const TubeMesh mesh =
        tube({{0, 0, 0}, {0.1, 0, 0}, Vec3(0.1, 0, 0) + 0.1 * back}, kRadius, kSides);
    expect_sound(mesh);
    for (const Vec3& p : mesh.positions) EXPECT_LT(p.x(), 0.1 + 1.001 * kRadius) << turn;
  }
}

TEST(Tube, NoVertexIsFarFromItsLine) {
  Random random(7);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vec3> line = {Vec3::Zero()};
    for (int i = 0; i < 8; ++i) line.push_back(line.back() + 0.05 * random.direction());
    const TubeMesh mesh = tube(line, kRadius, kSides);
    expect_sound(mesh);
    for (const Vec3& p : mesh.positions) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vec3& point : line) nearest = std::min(nearest, (p - point).norm());
      EXPECT_LE(nearest, 2.0 * kRadius * (1.0 + 1e-9));
    }
  }
}

}  // namespace
}  // namespace anthrob
