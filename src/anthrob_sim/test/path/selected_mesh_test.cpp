// The thesis's selection of a mesh's vertices by half-space: against CGAL, and where it jumps.
#include "path/selected_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "anthrob_sim/model/robot_model.h"
#include "mesh_reference.h"
#include "mesh_shapes.h"
#include "path/mesh_surface.h"
#include "support.h"
#include "tendon.h"

namespace anthrob {
namespace {

using testing_support::Random;
using testing_support::random_body;
using testing_support::random_outside;
using testing_support::Tendon;

TEST(SelectedMesh, AgreesWithCgal) {
  Random random(1);
  int wrapped = 0;
  for (int i = 0; i < 150; ++i) {
    const std::vector<Vec3> points = random_body(random);
    const Vec3 chi = random.direction();
    const MeshSurface whole(points, chi);
    const Vec3 p = random_outside(random, whole), q = random_outside(random, whole);
    const auto way = testing_support::reference_way_over_selection(points, p, q, chi);
    Tendon tendon(std::make_shared<SelectedMesh>(points, chi));
    const WrapContact& contact = tendon.start(p, q);
    if (!way.wraps && contact.touching) continue;  // p below the hull: the thesis has no answer
    EXPECT_EQ(contact.touching, way.wraps) << i;
    EXPECT_NEAR(tendon.length(), way.length, 1e-9) << i;
    EXPECT_LT((contact.direction_in - way.direction_in).norm(), 1e-6) << i;
    EXPECT_LT((contact.direction_out - way.direction_out).norm(), 1e-6) << i;
    wrapped += contact.touching;
  }
  EXPECT_GT(wrapped, 40);
}

/// On an ever finer sphere what the selection leaves out shrinks to nothing.
TEST(SelectedMesh, ConvergesToASphere) {
  const Vec3 p(0.3, 0.1, 2.0), q(0.5, -0.2, -1.7);
  const double angle = std::acos(p.normalized().dot(q.normalized()));
  const double exact = std::sqrt(p.squaredNorm() - 1) + std::sqrt(q.squaredNorm() - 1) + angle -
                       std::acos(1 / p.norm()) - std::acos(1 / q.norm());
  double last = 1.0;
  for (int rounds = 1; rounds <= 4; ++rounds) {
    Tendon tendon(
        std::make_shared<SelectedMesh>(testing_support::icosphere(rounds), Vec3::UnitX()));
    tendon.start(p, q);
    const double error = std::abs(tendon.length() - exact);
    EXPECT_LT(error, last);
    last = error;
  }
  EXPECT_LT(last, 2e-3 * exact);
}

TEST(SelectedMesh, IsStraightWhereNothingIsSelected) {
  Tendon tendon(std::make_shared<SelectedMesh>(testing_support::icosphere(2), Vec3::UnitX()));
  EXPECT_FALSE(tendon.start({3, 0, 2}, {3, 0.1, -2}).touching);
  EXPECT_NEAR(tendon.length(), Vec3(0, 0.1, 4).norm(), 1e-12);
  // Along chi there is no side.
  EXPECT_FALSE(tendon.start({3, 0, 0}, {2, 0, 0}).touching);
}

TEST(SelectedMesh, DrawnPathIsTheSolvedPath) {
  const auto surface = std::make_shared<SelectedMesh>(testing_support::icosphere(2), Vec3::UnitX());
  Tendon tendon(surface);
  const WrapContact& contact = tendon.start({0.3, 0.1, 1.5}, {0.3, 0.0, -1.5});
  ASSERT_TRUE(contact.touching);
  std::vector<Vec3> points;
  surface->trace(contact, points);
  EXPECT_EQ(points.front(), contact.entry);
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  EXPECT_NEAR(length, contact.length_on, 1e-9);
}

/// What the tendon may run over, by numbers of vertices; P and Q are -2 and -1. Empty where P lies
/// below the hull: there the thesis has no answer.
std::set<std::array<int, 3>> upper_side(const std::vector<Vec3>& points, const Vec3& p,
                                        const Vec3& q, const Vec3& chi) {
  std::vector<std::array<Vec3, 3>> facets;
  testing_support::reference_way_over_selection(points, p, q, chi, &facets);
  std::set<std::array<int, 3>> numbered;
  bool has_p = false;
  for (const auto& facet : facets) {
    std::array<int, 3> corners{};
    for (int k = 0; k < 3; ++k) {
      const auto at = std::find(points.begin(), points.end(), facet[k]);
      corners[k] =
          at == points.end() ? (facet[k] == p ? -2 : -1) : static_cast<int>(at - points.begin());
    }
    std::sort(corners.begin(), corners.end());
    has_p = has_p || corners[0] == -2;
    numbered.insert(corners);
  }
  if (!has_p) numbered.clear();
  return numbered;
}

/// A path point moves past a bone: the length is continuous while the upper side keeps its facets;
/// it jumps when a vertex enters or leaves the half-space, and when a facet turns away from z.
TEST(SelectedMesh, JumpsOnlyWhereTheUpperSideChanges) {
  Random random(2);
  int by_vertex = 0, by_facet = 0, steady = 0;
  double largest = 0.0;
  for (int sweep = 0; sweep < 60; ++sweep) {
    const std::vector<Vec3> points = random_body(random);
    const Vec3 chi = random.direction();
    const auto surface = std::make_shared<SelectedMesh>(points, chi);
    const MeshSurface whole(points, Vec3::UnitX());
    Vec3 p = random_outside(random, whole);
    const Vec3 q = random_outside(random, whole), velocity = random.direction();
    Tendon tendon(surface);
    tendon.start(p, q);
    for (int i = 0; i < 60; ++i) {
      const Vec3 next = p + 1e-4 * velocity;
      const double before = tendon.length();
      tendon.move(next, q);
      const double excess = std::abs(tendon.length() - before) - 1e-4;
      ASSERT_TRUE(std::isfinite(excess)) << sweep << " " << i;
      const auto side = upper_side(points, p, q, chi);
      if (!side.empty() && side == upper_side(points, next, q, chi)) {
        ++steady;
        EXPECT_LT(excess, 1e-9) << sweep << " " << i;
      } else if (excess > 1e-6) {
        const bool same = surface->selection(p, q) == surface->selection(next, q);
        ++(same ? by_facet : by_vertex);
        largest = std::max(largest, excess);
      }
      p = next;
    }
  }
  char text[32];
  std::snprintf(text, sizeof(text), "%.2g", largest);
  RecordProperty("largest_jump_m", text);
  RecordProperty("jumps_by_vertex", by_vertex);
  RecordProperty("jumps_by_facet", by_facet);
  EXPECT_GT(steady, 1500);
  EXPECT_GT(by_vertex, 3);
  EXPECT_GT(by_facet, 0);
}

}  // namespace
}  // namespace anthrob
