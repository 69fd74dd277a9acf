// Meshes as wrapping surfaces: against CGAL's exact geodesics, closed forms, and virtual work.
#include "path/mesh_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/path/muscle_path.h"
#include "anthrob_sim/skeleton/kinematic_tree.h"
#include "mesh_reference.h"
#include "mesh_shapes.h"
#include "path/horizon.h"
#include "support.h"
#include "tendon.h"

namespace anthrob {
namespace {

using testing_support::Random;
using testing_support::random_body;
using testing_support::random_outside;
using testing_support::reference_way;
using testing_support::ReferenceWay;
using testing_support::Tendon;

/// `ANTHROB_CAMPAIGN=20000` runs the long form.
int campaign(int usual) {
  const char* text = std::getenv("ANTHROB_CAMPAIGN");
  return text == nullptr ? usual : std::atoi(text);
}

constexpr double kSameLength = 1e-7;                  // [m]
constexpr double kSameDirection = 0.05 * M_PI / 180;  // [rad]

/// Comparisons with the reference, and what became of them.
struct Tally {
  int wrapped = 0, leaning = 0, ties = 0;
  double worst_length = 0.0, worst_direction = 0.0;

  void compare(Tendon& tendon, const Vec3& p, const ReferenceWay& way, const std::string& what) {
    const WrapContact& contact = tendon.contact();
    EXPECT_EQ(contact.touching, way.wraps) << what;
    const double length = std::abs(tendon.length() - way.length);
    EXPECT_LT(length, kSameLength) << what;
    worst_length = std::max(worst_length, length);
    if (!contact.touching) return;
    ++wrapped;
    leaning += contact.entry == p;
    EXPECT_TRUE(contact.direction_in.allFinite() && contact.direction_out.allFinite()) << what;
    const double direction = std::max((contact.direction_in - way.direction_in).norm(),
                                      (contact.direction_out - way.direction_out).norm());
    if (direction < kSameDirection) {
      worst_direction = std::max(worst_direction, direction);
    } else {
      ++ties;  // two ways of the same length, as both were found to have
    }
  }

  void report(const std::string& start, int cases) const {
    const auto record = [&](const std::string& what, double value) {
      char text[32];
      std::snprintf(text, sizeof(text), "%.2g", value);
      ::testing::Test::RecordProperty(start + "_" + what, text);
    };
    ::testing::Test::RecordProperty(start + "_cases", cases);
    ::testing::Test::RecordProperty(start + "_wrapped", wrapped);
    ::testing::Test::RecordProperty(start + "_leaning", leaning);
    ::testing::Test::RecordProperty(start + "_ties", ties);
    record("worst_length_m", worst_length);
    record("worst_direction_deg", worst_direction * 180 / M_PI);
    EXPECT_GT(wrapped, cases / 5);
    EXPECT_LE(ties, 1 + cases / 200);
  }
};

TEST(MeshSurface, RandomBodiesAgreeWithCgal) {
  Random random(1);
  Tally cold, warm, prepared;
  const int cases = campaign(300);
  for (int i = 0; i < cases; ++i) {
    const std::vector<Vec3> points = random_body(random);
    const Vec3 chi = random.integer(0, 3) == 0 ? Vec3(Vec3::Zero()) : random.direction();
    const auto surface = std::make_shared<MeshSurface>(points, chi);
    Tendon tendon(surface);
    Vec3 p = random_outside(random, *surface), q = random_outside(random, *surface);
    tendon.start(p, q);
    cold.compare(tendon, p, reference_way(points, p, q, chi), "cold " + std::to_string(i));
    // A way off, so that rims and strips change.
    const double stride = std::pow(10.0, random.uniform(-5.0, -2.0));
    for (int step = 0; step < 5; ++step) {
      const Vec3 np = p + random.vector(stride), nq = q + random.vector(stride);
      if (HullLocator(surface->hull()).locate(np, 0).moved) continue;
      if (HullLocator(surface->hull()).locate(nq, 0).moved) continue;
      p = np, q = nq;
      tendon.move(p, q);
    }
    const ReferenceWay way = reference_way(points, p, q, chi);
    warm.compare(tendon, p, way, "warm " + std::to_string(i));
    // One end fixed to the body, and the distances from there known before; cold or warm.
    const bool first = i % 2 == 0;
    Tendon fixed(surface->prepared_for(first ? &p : nullptr, first ? nullptr : &q));
    const Vec3 away = random.vector(i % 3 == 0 ? 0.0 : stride);
    fixed.start(first ? p : p + away, first ? q + away : q);
    fixed.move(p, q);
    prepared.compare(fixed, p, way, "prepared " + std::to_string(i));
  }
  cold.report("cold", cases);
  warm.report("warm", cases);
  prepared.report("prepared", cases);
  EXPECT_GT(cold.leaning, cases / 20);
}

/// Where the point for which a surface was prepared is not: as if it were not prepared.
TEST(MeshSurface, PreparationIsNoPromise) {
  Random random(6);
  for (int i = 0; i < 200; ++i) {
    const auto surface = std::make_shared<MeshSurface>(random_body(random), random.direction());
    const Vec3 p = random_outside(random, *surface), q = random_outside(random, *surface);
    const Vec3 elsewhere = q + random.vector(1e-3);
    Tendon plain(surface), prepared(surface->prepared_for(nullptr, &elsewhere));
    plain.start(p, q);
    prepared.start(p, q);
    EXPECT_EQ(plain.length(), prepared.length());
  }
}

TEST(Horizon, WalkedIsTheOneFound) {
  Random random(7);
  for (int i = 0; i < 300; ++i) {
    const MeshSurface surface(random_body(random), Vec3::UnitX());
    const ConvexHull& hull = surface.hull();
    const Vec3 p = random_outside(random, surface);
    Horizon walked, flooded;
    walked.reserve(hull);
    flooded.reserve(hull);
    flooded.flood(hull, p, HullLocator(hull).locate(p, 0).facet);
    std::vector<int> expected = flooded.edges();
    ASSERT_TRUE(walked.trace(hull, p, expected[i % expected.size()]));
    std::vector<int> found = walked.edges();
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
    EXPECT_FALSE(walked.trace(hull, p, hull.edge(expected[0]).twin)) << "the wrong side of it";
  }
}

/// From a point in the plane of a plate rounding decides which of its triangles count as seen: a
/// walk round some of them is not taken for the horizon.
TEST(Horizon, IslandsAreRefused) {
  Random random(8);
  int refused = 0;
  for (int i = 0; i < 50; ++i) {
    // A drum: two plates of many triangles, turned so that rounding has something to do.
    const Mat3 turn = Quat(Eigen::AngleAxisd(random.uniform(0, 3), random.direction())).matrix();
    std::vector<Vec3> points;
    for (int k = 0; k < 24; ++k) {
      const double angle = 0.1 + 2 * M_PI * k / 24;
      for (const double z : {-0.3, 0.3}) {
        points.push_back(turn * Vec3(std::cos(angle), std::sin(angle), z));
      }
    }
    const ConvexHull hull(points);
    const Vec3 p = turn * Vec3(2.0, 0.3, 0.3);
    Horizon horizon;
    horizon.reserve(hull);
    for (int h = 0; h < hull.half_edge_count(); ++h) {
      const bool is_border = hull.height(ConvexHull::facet_of(h), p) <= 0.0 &&
                             hull.height(ConvexHull::facet_of(hull.edge(h).twin), p) > 0.0;
      if (!is_border) {
        EXPECT_FALSE(horizon.trace(hull, p, h));
      } else if (!horizon.trace(hull, p, h)) {
        ++refused;
        EXPECT_LT(horizon.edges().size(), 24u) << "an island in a plate";
      } else {
        // It separates the drum's near side from the far one.
        EXPECT_GE(horizon.edges().size(), 6u);
      }
    }
  }
  EXPECT_GT(refused, 0);
}

/// A mesh in the path of one of model III's muscles.
struct MeshOnPath {
  std::string muscle;
  const PathModel* path;
  std::size_t index;
  std::shared_ptr<const MeshSurface> surface;

  std::pair<Vec3, Vec3> ends(const std::vector<BodyState>& bodies) const {
    const auto& list = path->obstacles();
    const Pose& X_WB = bodies[list[index].body].X_WB;
    const auto local = [&](const PathObstacle& point) {
      return X_WB.to_local(bodies[point.body].X_WB * point.point_B);
    };
    return {local(list[index - 1]), local(list[index + 1])};
  }
};

std::vector<MeshOnPath> meshes_of(const RobotModel& model) {
  std::vector<MeshOnPath> found;
  for (const MuscleModel& muscle : model.muscles) {
    for (std::size_t i = 0; i < muscle.path->obstacles().size(); ++i) {
      const auto& surface = muscle.path->obstacles()[i].surface;
      if (auto mesh = std::dynamic_pointer_cast<const MeshSurface>(surface)) {
        found.push_back({muscle.name, muscle.path.get(), i, mesh});
      }
    }
  }
  return found;
}

bool are_same(const ConvexHull& a, const ConvexHull& b) {
  bool same = a.half_edge_count() == b.half_edge_count();
  for (int h = 0; same && h < a.half_edge_count(); ++h) same = a.from(h) == b.from(h);
  return same;
}

TEST(MeshWrapping, HullsHaveOneOrderWhereverTheyLieInMemory) {
  Random random(5);
  std::vector<Vec3> ball;
  for (int i = 0; i < 100; ++i) ball.push_back(random.direction());
  // Of a prism, the ends can be divided into triangles in several ways.
  for (std::vector<Vec3> points : {ball, testing_support::prism(12, 0.02, 0.05)}) {
    const ConvexHull first(points);
    std::vector<std::vector<char>> between;
    for (int i = 0; i < 50; ++i) {
      between.emplace_back(static_cast<std::size_t>(random.uniform(1.0, 4000.0)));
      if (i % 3 == 2) between.erase(between.begin() + i / 3);
      EXPECT_TRUE(are_same(ConvexHull(points), first)) << i;
    }
  }
  const ConvexHull first(ball);
  for (int i = 0; i < 20; ++i) {
    std::rotate(ball.begin(), ball.begin() + 7 + i, ball.end());
    EXPECT_TRUE(are_same(ConvexHull(ball), first)) << "another order of the points";
  }
}

TEST(MeshSurface, PosturesOfModelThreeAgreeWithCgal) {
  const auto model = load_robot_model(testing_support::config("anthrob/model_III.yaml"));
  const std::vector<MeshOnPath> meshes = meshes_of(*model);
  ASSERT_EQ(meshes.size(), 8u);
  std::vector<Tendon> warm;
  for (const MeshOnPath& mesh : meshes) warm.emplace_back(mesh.surface);
  Random random(2);
  Tally cold_tally, warm_tally;
  const int postures = campaign(40);
  KinematicTree tree(*model->skeleton);
  std::vector<BodyState> bodies;
  int compared = 0;
  for (int i = 0; i < postures; ++i) {
    tree.place(testing_support::random_posture(random), {}, bodies);
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      // A long campaign takes each posture for one muscle.
      if (postures > 1000 && static_cast<std::size_t>(i) % meshes.size() != m) continue;
      const auto [p, q] = meshes[m].ends(bodies);
      const HullLocator locator(meshes[m].surface->hull());
      if (locator.locate(p, 0).moved || locator.locate(q, 0).moved) continue;
      ++compared;
      const std::string what = meshes[m].muscle + " " + std::to_string(i);
      const ReferenceWay way =
          reference_way(meshes[m].surface->hull().vertices(), p, q, meshes[m].surface->chi());
      Tendon cold(meshes[m].surface);
      cold.start(p, q);
      cold_tally.compare(cold, p, way, "cold " + what);
      // From the posture before, and by way of a place close by.
      if (i < static_cast<int>(meshes.size())) warm[m].start(p, q);
      if (i % 2 == 0) warm[m].move(p + random.vector(1e-4), q);
      warm[m].move(p, q);
      warm_tally.compare(warm[m], p, way, "warm " + what);
    }
  }
  cold_tally.report("cold", compared);
  warm_tally.report("warm", compared);
}

/// Model III through its work space for 30 s: the length moves no more than the ends do, and
/// where directions turn fast, a solution from nothing turns as fast.
TEST(MeshSurface, HalfAMinuteOfModelThreeIsContinuous) {
  const auto model = load_robot_model(testing_support::config("anthrob/model_III.yaml"));
  const std::vector<MeshOnPath> meshes = meshes_of(*model);
  std::vector<Tendon> tendons;
  for (const MeshOnPath& mesh : meshes) tendons.emplace_back(mesh.surface);
  std::vector<std::pair<Vec3, Vec3>> last(meshes.size());
  KinematicTree tree(*model->skeleton);
  std::vector<BodyState> bodies;
  int turns = 0, wrapped = 0;
  const int steps = 30000;
  for (int i = 0; i < steps; ++i) {
    const double t = 1e-3 * i;
    const Vec3 tilt(0.6 * std::sin(0.7 * t), 0.5 * std::sin(0.45 * t + 1),
                    0.8 * std::sin(0.31 * t));
    const Quat q(Eigen::AngleAxisd(tilt.norm() + 1e-9, (tilt + Vec3(1e-9, 0, 0)).normalized()));
    tree.place({q.w(), q.x(), q.y(), q.z(), 1.1 + std::sin(0.9 * t)}, {}, bodies);
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      const auto [p, e] = meshes[m].ends(bodies);
      if (i == 0) tendons[m].start(p, e);
      const WrapContact before = tendons[m].contact();
      const double length = tendons[m].length();
      const WrapContact& now = tendons[m].move(p, e);
      const auto [lp, le] = last[m];
      last[m] = {p, e};
      if (i == 0) continue;
      wrapped += now.touching;
      // Steeper than the ends move where a point lies inside the bone or the tendon leans.
      const double steepest = std::max({1.0, before.pull_in.norm(), before.pull_out.norm(),
                                        now.pull_in.norm(), now.pull_out.norm()});
      const double moved = 1.05 * steepest * ((p - lp).norm() + (e - le).norm()) + 2e-9;
      ASSERT_LE(std::abs(tendons[m].length() - length), moved) << meshes[m].muscle << " " << t;
      if ((now.direction_in - before.direction_in).norm() < 0.01 &&
          (now.direction_out - before.direction_out).norm() < 0.01) {
        continue;
      }
      ++turns;
      Tendon cold(meshes[m].surface);
      const WrapContact first = cold.start(lp, le);
      const WrapContact second = cold.start(p, e);
      EXPECT_LT((second.direction_out - now.direction_out).norm(), 1e-6) << meshes[m].muscle;
      EXPECT_LT((first.direction_out - before.direction_out).norm(), 1e-6) << meshes[m].muscle;
    }
  }
  RecordProperty("fast_turns", turns);
  EXPECT_GT(wrapped, steps);
  EXPECT_LT(turns, steps / 50);
}

/// Order in which the error of the length falls with the size of the facets.
template <class Body>
void expect_second_order(const Body& body, const Vec3& p, const Vec3& q, double exact) {
  std::vector<double> errors;
  for (int round = 1; round <= 4; ++round) {
    Tendon tendon(std::make_shared<MeshSurface>(body(round), Vec3::UnitX()));
    tendon.start(p, q);
    ASSERT_TRUE(tendon.contact().touching);
    const double error = exact - tendon.length();
    EXPECT_GT(error, 0.0) << "an inscribed body is smaller";
    errors.push_back(error);
  }
  // Single steps scatter with where edges happen to lie; over two steps the order shows.
  EXPECT_LT(errors[3], errors[1] / 8.0);
  EXPECT_LT(errors[2], errors[0] / 8.0);
  EXPECT_LT(errors[3], 1e-3 * exact);
}

TEST(MeshSurface, ConvergesToASphere) {
  const Vec3 p(0.3, 0.1, 2.0), q(0.5, -0.2, -1.7);
  const double angle = std::acos(p.normalized().dot(q.normalized()));
  const double exact = std::sqrt(p.squaredNorm() - 1) + std::sqrt(q.squaredNorm() - 1) + angle -
                       std::acos(1 / p.norm()) - std::acos(1 / q.norm());
  expect_second_order([](int n) { return testing_support::icosphere(n + 1); }, p, q, exact);
}

TEST(MeshSurface, ConvergesToACylinder) {
  const Vec3 p(0.3, 0.5, 2.0), q(0.2, -0.4, -1.7);
  const double l1 = std::hypot(0.3, 2.0), l2 = std::hypot(0.2, 1.7);
  const double turn = std::acos((0.3 * 0.2 - 2.0 * 1.7) / (l1 * l2));
  const double plane = std::sqrt(l1 * l1 - 1) + std::sqrt(l2 * l2 - 1) + turn - std::acos(1 / l1) -
                       std::acos(1 / l2);
  expect_second_order([](int n) { return testing_support::prism(8 << n, 1.0, 5.0); }, p, q,
                      std::hypot(plane, 0.9));
}

/// The pulls are the gradient of the length, whatever the tendon does: wrap, lean on the border of
/// its side, end inside the bone.
TEST(MeshSurface, DoesNoWorkOfItsOwn) {
  Random random(3);
  int wrapped = 0, leaning = 0, moved = 0, kinks = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto surface = std::make_shared<MeshSurface>(random_body(random), random.direction());
    Vec3 ends[2] = {random_outside(random, *surface), random_outside(random, *surface)};
    if (i % 4 == 0) {
      const HullPoint found = HullLocator(surface->hull()).locate(0.9 * ends[1], 0);
      const Vec3 on_surface =
          found.moved ? found.p
                      : HullLocator(surface->hull()).locate(1e-3 * ends[1].normalized(), 0).p;
      ends[1] = on_surface - random.uniform(1e-5, 3e-4) * on_surface.normalized();
    }
    Tendon tendon(surface);
    const WrapContact contact = tendon.start(ends[0], ends[1]);
    if (!contact.touching) continue;
    const double length = tendon.length();
    const auto length_at = [&](const Vec3& p, const Vec3& q) {
      Tendon other(surface);
      other.start(p, q);
      return other.length();
    };
    const double h = 1e-7;
    const Vec3 dp = random.direction(), dq = random.direction();
    const double ahead = (length_at(ends[0] + h * dp, ends[1] + h * dq) - length) / h;
    const double back = (length - length_at(ends[0] - h * dp, ends[1] - h * dq)) / h;
    const double expected = -contact.pull_in.dot(dp) + contact.pull_out.dot(dq);
    if (std::abs(ahead - back) > 2e-3) {
      ++kinks;  // at a tie, or where a border of facets is crossed
      EXPECT_GE(expected, std::min(ahead, back) - 1e-2) << i;
      EXPECT_LE(expected, std::max(ahead, back) + 1e-2) << i;
      continue;
    }
    EXPECT_NEAR(0.5 * (ahead + back), expected, 2e-3) << i;
    ++wrapped;
    moved += contact.penetration > 0.0;
    leaning += contact.entry == ends[0];
  }
  RecordProperty("kinks", kinks);
  EXPECT_GT(wrapped, 500);
  EXPECT_GT(leaning, 50);
  EXPECT_GT(moved, 100);
  EXPECT_LT(kinks, wrapped / 10);
}

/// Over random sweeps the length changes by no more than the ends move, through touch-down,
/// lift-off and change of sides.
TEST(MeshSurface, LengthIsContinuous) {
  Random random(4);
  int touched = 0, lifted = 0;
  for (int sweep = 0; sweep < 300; ++sweep) {
    const auto surface = std::make_shared<MeshSurface>(random_body(random), Vec3::Zero());
    Tendon tendon(surface);
    Vec3 p = random_outside(random, *surface);
    const Vec3 q = random_outside(random, *surface);
    tendon.start(p, q);
    const Vec3 velocity = -p.normalized().cross(random.direction());
    for (int i = 0; i < 400; ++i) {
      const Vec3 next = p + 2e-4 * (velocity - 0.3 * p.normalized() * std::sin(0.05 * i));
      if (HullLocator(surface->hull()).locate(next, 0).moved) break;
      const bool was = tendon.contact().touching;
      const double before = tendon.length();
      tendon.move(next, q);
      ASSERT_LE(std::abs(tendon.length() - before), (next - p).norm() + 2e-9) << sweep << " " << i;
      touched += !was && tendon.contact().touching;
      lifted += was && !tendon.contact().touching;
      p = next;
    }
  }
  EXPECT_GT(touched, 10);
  EXPECT_GT(lifted, 10);
}

/// The answer does not remember how it was reached, and a copied state gives the same bits.
TEST(MeshSurface, WarmEqualsColdAndCopiesRepeat) {
  Random random(5);
  const auto surface =
      std::make_shared<MeshSurface>(testing_support::icosphere(3), Vec3(1, 0.2, 0));
  Tendon warm(surface), copy(surface);
  warm.start({0.4, 0.2, 1.5}, {0.3, 0.1, -1.4});
  for (int i = 0; i < 500; ++i) {
    const Vec3 p(0.4 + 0.2 * std::sin(0.03 * i), 0.3 * std::cos(0.02 * i), 1.5);
    const Vec3 q(0.3, 0.1 * std::sin(0.05 * i), -1.4);
    std::copy(warm.state().data(), warm.state().data() + surface->state_size(),
              copy.state().data());
    warm.move(p, q);
    copy.move(p, q);
    EXPECT_EQ(warm.length(), copy.length());
    EXPECT_EQ(warm.contact().direction_in, copy.contact().direction_in);
    Tendon cold(surface);
    cold.start(p, q);
    EXPECT_NEAR(warm.length(), cold.length(), 5e-9);
  }
  const MeshSurface::Counts counts = MeshSurface::counts(warm.state());
  EXPECT_EQ(counts.solved, 501);
  EXPECT_EQ(counts.cold, 1);
}

TEST(MeshSurface, DrawnPathIsTheSolvedPath) {
  const auto surface = std::make_shared<MeshSurface>(testing_support::icosphere(2), Vec3::UnitX());
  for (const double x : {0.3, -0.3}) {  // free, and leaning on the border
    Tendon tendon(surface);
    const WrapContact& contact = tendon.start({x, 0.1, 1.5}, {x, 0.0, -1.5});
    ASSERT_TRUE(contact.touching);
    std::vector<Vec3> points;
    surface->trace(contact, points);
    EXPECT_EQ(points.front(), contact.entry);
    EXPECT_EQ(points.back(), contact.exit);
    double length = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
    EXPECT_NEAR(length, contact.length_on, 1e-9);
  }
}

TEST(MeshSurface, AwkwardPlacesStayFinite) {
  // A cube: facets in one plane, points on corners, edges, faces, in the middle, in line with
  // edges.
  std::vector<Vec3> cube;
  for (int i = 0; i < 8; ++i) cube.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  const auto surface = std::make_shared<MeshSurface>(cube, Vec3(1, 0, 0));
  const Vec3 places[] = {{0, 0, 0}, {1, 1, 1},  {-1, 1, -1}, {1, 1, 0},
                         {1, 0, 0}, {0, 0, 3},  {0, 0, -3},  {1, 1, 3},
                         {3, 0, 0}, {-3, 0, 0}, {1, 0, 3},   {0.5, 0.5, 0.5}};
  for (const Vec3& p : places) {
    for (const Vec3& q : places) {
      Tendon tendon(surface);
      const WrapContact& contact = tendon.start(p, q);
      EXPECT_TRUE(std::isfinite(tendon.length())) << p.transpose() << " to " << q.transpose();
      EXPECT_LT(tendon.length(), 20.0);
      EXPECT_TRUE(contact.pull_in.allFinite() && contact.pull_out.allFinite());
      EXPECT_NEAR(contact.direction_in.norm(), 1.0, 1e-9);
      EXPECT_NEAR(contact.direction_out.norm(), 1.0, 1e-9);
    }
  }
}

TEST(MeshSurface, RefusesFlatBodies) {
  EXPECT_THROW(MeshSurface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, Vec3::UnitX()),
               std::invalid_argument);
  EXPECT_THROW(MeshSurface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, Vec3::UnitX()),
               std::invalid_argument);
  EXPECT_THROW(MeshSurface(std::vector<Vec3>(10, Vec3(1, 2, 3)), Vec3::UnitX()),
               std::invalid_argument);
}

}  // namespace
}  // namespace anthrob
