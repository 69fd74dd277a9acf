// Targets and their labelling: files, ambiguity, cliques against brute force.
#include "labelling/labeller.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "expect_bad_input.h"
#include "support.h"

namespace anthrob {
namespace mocap {
namespace {

using test::expect_bad_input;
using test::make_targets;

const char* kFile = R"(marker_diameter: 0.016
targets:
  scapula:
    markers: [[0, 0, 0], [0.1, 0, 0], [0, 0.07, 0], [0.03, 0.02, 0.09]]
  humerus:
    markers: [[0, 0, 0], [0.13, 0, 0], [0, 0.045, 0], [0.06, 0.03, 0.055]]
joints:
  shoulder: {parent: scapula, child: humerus, rest: [0, 1, 0, 0]}
)";

void refuse(const std::string& from, const std::string& to, const std::string& part) {
  std::string text = kFile;
  text.replace(text.find(from), from.size(), to);
  expect_bad_input([&] { TargetSet::parse(text, "targets.yaml", 0.003); }, part);
}

TEST(Targets, AreReadAndWritten) {
  const TargetSet set = TargetSet::parse(kFile, "targets.yaml", 0.003);
  ASSERT_EQ(set.targets.size(), 2u);
  EXPECT_EQ(set.targets[1].markers[1], Vec3(0.13, 0, 0));
  EXPECT_EQ(set.joints[0].rest.x(), 1.0);
  EXPECT_EQ(set.joints[0].child_mount.w(), 1.0);
  const TargetSet again = TargetSet::parse(set.to_yaml(), "again", 0.003);
  EXPECT_EQ(again.targets[0].markers, set.targets[0].markers);
  EXPECT_EQ(again.joints[0].child, 1);
}

TEST(Targets, ThatAreWrongAreRefused) {
  refuse("[0, 0.07, 0]", "[0, 0.07]",
         "targets.yaml:4: targets.scapula.markers.2: a list of 2: "
         "expected three numbers [x, y, z] [m]");
  refuse("  scapula:", "  left-arm:",
         "targets.yaml:3: targets.left-arm: 'left-arm': expected a name in lower_snake_case");
  refuse("  shoulder:", "  'a,b':", "joints.a,b: 'a,b': expected a name in lower_snake_case");
  refuse("  shoulder:", "  humerus:", "joints.humerus: a target has this name");
  refuse("parent: scapula", "parent: spacula",
         "targets.yaml:8: joints.shoulder.parent: spacula: "
         "expected the name of a target");
  refuse("child: humerus", "child: scapula", "the same target");
  refuse("rest: [0, 1, 0, 0]", "rest: [0, 1, 1, 0]", "unit quaternion");
  refuse("rest:", "resr:", "resr: unknown key");
  refuse("marker_diameter: 0.016", "marker_diameter: -1",
         "targets.yaml:1: marker_diameter: -1: expected a number in [0, 1] [m]");
  refuse("[0.1, 0, 0]", "[0.01, 0, 0]", "touch");
  refuse("[[0, 0, 0], [0.1, 0, 0], [0, 0.07, 0], [0.03, 0.02, 0.09]]",
         "[[0, 0, 0], [0.1, 0, 0], [0.25, 0, 0]]", "on one line");
  refuse("[[0, 0, 0], [0.1, 0, 0], [0, 0.07, 0], [0.03, 0.02, 0.09]]", "[[0, 0, 0], [0.1, 0, 0]]",
         "3 to 16 markers");
  refuse("rest: [0, 1, 0, 0]", "rest: ~", "joints.shoulder.rest: (empty): expected a value");
  refuse("[0.1, 0, 0]", "[100, 0, 0]",
         "targets.yaml:4: targets.scapula.markers.1: a list of 3: expected metres: less than 2 m "
         "from marker 0");
  refuse("[0.1, 0, 0]", "[1e200, 0, 0]", "expected metres");
}

TEST(Targets, ThatContainThemselvesAreRefused) {
  for (const char* text : {"targets: &x {a: *x}\n", "marker_diameter: 0.016\ntargets: &x {a: *x}\n",
                           "targets: &x [*x]\n", "extra: &e {x: *e}\n"}) {
    expect_bad_input([&] { TargetSet::parse(text, "targets.yaml", 0.003); },
                     "nested more than 100 deep");
  }
}

TEST(Targets, ThatAreAmbiguousAreRefusedWithTheEdges) {
  // An isosceles triangle, and a second target like the first.
  refuse("[[0, 0, 0], [0.1, 0, 0], [0, 0.07, 0], [0.03, 0.02, 0.09]]",
         "[[0, 0, 0], [0.1, 0.04, 0], [0.1, -0.04, 0]]",
         "targets.scapula: ambiguous: its markers can be taken for each other, equal edges: "
         "scapula 0-1 (107.7 mm) and scapula 0-2 (107.7 mm)");
  refuse("[[0, 0, 0], [0.13, 0, 0], [0, 0.045, 0], [0.06, 0.03, 0.055]]",
         "[[0, 0, 0], [0, 0.1, 0], [0.07, 0, 0], [0.02, 0.03, 0.09]]",
         "can be taken for those of humerus");
}

TEST(Targets, OfAnthrobHaveNoAmbiguousTriples) {
  EXPECT_EQ(count_ambiguous_triples(make_targets().targets, 0.003), 0);
}

MarkerPoint point_at(const Vec3& p, int blob) {
  MarkerPoint point;
  point.p = p;
  point.image[0] = point.image[1] = Vec2::Zero();
  point.blob[0] = point.blob[1] = blob;
  return point;
}

Labelling search(const MarkerTarget& target, const std::vector<MarkerPoint>& points,
                 LabellingOptions options = {}) {
  CliqueSearch clique(target, options);
  std::vector<Edge> edges;
  find_edges(points, clique.longest_edge() + options.edge_tolerance, edges);
  return clique.find(points, edges, std::vector<char>(points.size(), 1));
}

/// Size of the largest assignment of markers to points that keeps all edges within the tolerance
/// and fits as the search demands.
int brute_force(const MarkerTarget& target, const std::vector<MarkerPoint>& points,
                const LabellingOptions& options, std::vector<int>& image, std::size_t marker = 0) {
  if (marker == target.markers.size()) {
    PointPairs pairs;
    for (std::size_t i = 0; i < image.size(); ++i) {
      if (image[i] >= 0) pairs.add(target.markers[i], points[static_cast<std::size_t>(image[i])].p);
    }
    if (pairs.size() < 3) return 0;
    const double limit = pairs.size() > 3 ? options.rms_tolerance : options.triple_tolerance;
    return fit_rigid(pairs).rms <= limit ? static_cast<int>(pairs.size()) : 0;
  }
  image.push_back(-1);
  int best = brute_force(target, points, options, image, marker + 1);
  for (std::size_t p = 0; p < points.size(); ++p) {
    bool fits = true;
    for (std::size_t i = 0; i < marker && fits; ++i) {
      if (image[i] < 0) continue;
      const double want = (target.markers[i] - target.markers[marker]).norm();
      const double have = (points[static_cast<std::size_t>(image[i])].p - points[p].p).norm();
      fits = image[i] != static_cast<int>(p) && std::abs(want - have) <= options.edge_tolerance;
    }
    image[marker] = static_cast<int>(p);
    if (fits) best = std::max(best, brute_force(target, points, options, image, marker + 1));
  }
  image.pop_back();
  return best;
}

TEST(CliqueSearch, FindsTheLargestPartAsBruteForceDoes) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> place(-0.15, 0.15), noise(-0.0004, 0.0004);
  LabellingOptions options;
  options.edge_tolerance = 0.006;  // wide, so that chance has its say
  options.triple_tolerance = options.rms_tolerance = 0.003;
  const MarkerTarget target = make_targets().targets[0];
  int found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Pose X{exp_rotation(20.0 * Vec3(place(random), place(random), place(random))),
                 {0.0, 0.0, 1.0}};
    std::vector<MarkerPoint> points;
    const int seen = trial % 6;
    for (int i = 0; i < seen; ++i) {
      points.push_back(point_at(X * target.markers[static_cast<std::size_t>(i)] +
                                    Vec3(noise(random), noise(random), noise(random)),
                                i));
    }
    for (int i = 0; i < 8; ++i) {
      points.push_back(point_at(X.p + Vec3(place(random), place(random), place(random)), 100 + i));
    }
    std::shuffle(points.begin(), points.end(), random);
    std::vector<int> image;
    const Labelling labelling = search(target, points, options);
    EXPECT_EQ(labelling.count, brute_force(target, points, options, image)) << trial;
    found += labelling.count >= 3 ? 1 : 0;
  }
  EXPECT_GE(found, 100);
}

TEST(CliqueSearch, NamesTheMarkersAndFitsThem) {
  const MarkerTarget target = make_targets().targets[1];
  const Pose X{exp_rotation({0.3, -1.0, 2.0}), {0.1, 0.2, 1.3}};
  std::vector<MarkerPoint> points;
  for (const int i : {3, 0, 4, 1}) points.push_back(point_at(X * target.markers[i], i));
  const Labelling labelling = search(target, points);
  EXPECT_EQ(labelling.count, 4);
  EXPECT_EQ(labelling.point, (std::vector<int>{1, 3, -1, 0, 2}));
  EXPECT_LT((labelling.fit.X.p - X.p).norm(), 1e-9);
  EXPECT_LT(angular_distance(labelling.fit.X.R, X.R), 1e-7);
}

TEST(CliqueSearch, RefusesAMirrorImage) {
  const MarkerTarget target = make_targets().targets[1];
  for (const int count : {4, 5}) {
    std::vector<MarkerPoint> points;
    for (int i = 0; i < count; ++i) {
      Vec3 p = target.markers[static_cast<std::size_t>(i)];
      p.x() = -p.x();
      points.push_back(point_at(p + Vec3(0, 0, 1), i));
    }
    EXPECT_EQ(search(target, points).count, 0) << count;
  }
}

TEST(CliqueSearch, SaysWhenThreeMarkersCanBeTwoThings) {
  // An isosceles triangle within a target that is unique as a whole.
  const MarkerTarget target{"t", {{0, 0, 0}, {0.1, 0.04, 0}, {0.1, -0.04, 0}, {0.02, 0.05, 0.06}}};
  ASSERT_EQ(find_ambiguity(target, target, 0.003), std::nullopt);
  std::vector<MarkerPoint> points;
  for (int i = 0; i < 3; ++i)
    points.push_back(point_at(target.markers[static_cast<std::size_t>(i)], i));
  EXPECT_TRUE(search(target, points).ambiguous);
  points.push_back(point_at(target.markers[3], 3));
  EXPECT_FALSE(search(target, points).ambiguous);
  EXPECT_EQ(search(target, points).count, 4);
}

TEST(CliqueSearch, RivalsAreAsFarApartWhereverTheFrameIs) {
  // Two points half a millimetre before and behind a marker make one pose, not two.
  for (const double away : {0.0, 1.0}) {
    MarkerTarget target{"t", {{0, 0, 0}, {0.1, 0, 0}, {0, 0.07, 0}, {0.08, 0.09, 0}}};
    for (Vec3& marker : target.markers) marker.x() += away;
    std::vector<MarkerPoint> points;
    for (int i = 0; i < 3; ++i) {
      points.push_back(point_at(target.markers[static_cast<std::size_t>(i)], i));
    }
    for (const int side : {-1, 1}) {
      points.push_back(point_at(target.markers[3] + Vec3(0, 0, 0.0005 * side), 4 + side));
    }
    const Labelling labelling = search(target, points);
    EXPECT_EQ(labelling.count, 4);
    EXPECT_FALSE(labelling.ambiguous) << away;
  }
}

TEST(CliqueSearch, StaysWithinItsStepsInACrowd) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-0.1, 0.1);
  std::vector<MarkerPoint> points;
  for (int i = 0; i < 300; ++i) {
    points.push_back(point_at({place(random), place(random), place(random)}, i));
  }
  LabellingOptions options;
  options.step_limit = 5000;
  CliqueSearch clique(make_targets().targets[0], options);
  std::vector<Edge> edges;
  find_edges(points, clique.longest_edge() + 0.003, edges);
  EXPECT_TRUE(clique.find(points, edges, std::vector<char>(points.size(), 1)).gave_up);
}

TEST(Labeller, DoubtsThreeMarkersOfASearchThatGaveUp) {
  const MarkerTarget target = make_targets().targets[0];
  for (const int seen : {3, 4}) {
    std::vector<MarkerPoint> points;
    for (int i = 0; i < seen; ++i) {
      points.push_back(point_at(target.markers[static_cast<std::size_t>(i)], i));
    }
    for (const int limit : {20000, 4 + seen}) {  // the latter reaches the first answer only
      LabellingOptions options;
      options.step_limit = limit;
      Labeller labeller({target}, options, {});
      std::vector<Edge> edges;
      find_edges(points, labeller.longest_edge(), edges);
      std::vector<Labelling> labels;
      labeller.label(0.0, points, false, edges, labels);
      EXPECT_EQ(labels[0].gave_up, limit < 20000) << seen;
      EXPECT_EQ(labels[0].count, seen == 3 && limit < 20000 ? 0 : seen) << limit;
    }
  }
}

TEST(Labeller, DoubtsThreeMarkersInACrowd) {
  const MarkerTarget target = make_targets().targets[0];
  for (const int seen : {3, 4}) {
    for (const bool cut : {false, true}) {
      for (const int others : {0, 40, 60}) {
        std::vector<MarkerPoint> points;
        for (int i = 0; i < seen; ++i) {
          points.push_back(point_at(target.markers[static_cast<std::size_t>(i)], i));
        }
        for (int i = 0; i < others; ++i) points.push_back(point_at({10.0 + i, 0, 0}, 100 + i));
        Labeller labeller({target}, {}, {});
        std::vector<Edge> edges;
        find_edges(points, labeller.longest_edge(), edges);
        std::vector<Labelling> labels;
        labeller.label(0.0, points, cut, edges, labels);
        const bool doubted = seen == 3 && (cut || others == 60);
        EXPECT_EQ(labels[0].count, doubted ? 0 : seen) << seen << cut << others;
      }
    }
  }
}

TEST(Labeller, UsesNoBlobTwice) {
  // One point of each target made from the same left blob: only one of them can be real.
  const TargetSet set = make_targets();
  std::vector<MarkerPoint> points;
  for (int i = 0; i < 5; ++i) {
    points.push_back(point_at(set.targets[0].markers[static_cast<std::size_t>(i)], i));
  }
  for (int i = 0; i < 4; ++i) {
    points.push_back(
        point_at(set.targets[1].markers[static_cast<std::size_t>(i)] + Vec3(0.5, 0, 0), 10 + i));
  }
  points[8].blob[kLeft] = 2;
  Labeller labeller(set.targets, {}, {});
  std::vector<Edge> edges;
  find_edges(points, labeller.longest_edge(), edges);
  std::vector<Labelling> labels;
  labeller.label(0.0, points, false, edges, labels);
  EXPECT_EQ(labels[0].count, 5);
  EXPECT_EQ(labels[1].count, 3);
  EXPECT_EQ(labels[1].point[3], -1);
}

TEST(Labeller, GivesNobodyWhatTwoTargetsCanClaim) {
  // Alike but for one marker: what is seen of the others can be either's. A target that has more
  // takes what is its own, and leaves the other one to what remains.
  const MarkerTarget a = make_targets().targets[0];
  MarkerTarget b = a;
  b.name = "other";
  b.markers[4] += Vec3(0.03, 0.01, -0.02);
  ASSERT_EQ(find_ambiguity(a, b, 0.003), std::nullopt);
  Labeller labeller({a, b}, {}, {});
  std::vector<MarkerPoint> points;
  const auto label = [&] {
    std::vector<Edge> edges;
    find_edges(points, labeller.longest_edge(), edges);
    std::vector<Labelling> labels;
    labeller.label(0.0, points, false, edges, labels);
    return std::vector<int>{labels[0].count, labels[1].count};
  };
  for (int i = 0; i < 4; ++i) {
    points.push_back(point_at(a.markers[static_cast<std::size_t>(i)], i));
  }
  EXPECT_EQ(label(), (std::vector<int>{0, 0}));
  points.push_back(point_at(b.markers[4], 4));
  EXPECT_EQ(label(), (std::vector<int>{0, 5}));
  for (int i = 0; i < 4; ++i) {
    points.push_back(point_at(a.markers[static_cast<std::size_t>(i)] + Vec3(0.5, 0, 0), 10 + i));
  }
  EXPECT_EQ(label(), (std::vector<int>{4, 5}));
}

TEST(MotionPrior, DoubtsOnlyWhatContradictsSteadyMotion) {
  MotionPrior prior(MotionOptions(), Vec3::Zero());
  const Pose here{Mat3::Identity(), {0, 0, 1}}, there{exp_rotation({0.5, 0, 0}), {0, 0, 1}};
  EXPECT_FALSE(prior.contradicts(0.0, there));  // nothing known
  for (int i = 0; i < 6; ++i) {
    EXPECT_FALSE(prior.contradicts(0.01 * i, there)) << i;  // a few poses are no motion
    prior.accept(0.01 * i, here);
  }
  EXPECT_TRUE(prior.contradicts(0.06, there));
  EXPECT_FALSE(prior.contradicts(0.06, here));
  EXPECT_FALSE(prior.contradicts(1.0, there));    // too long ago
  EXPECT_FALSE(prior.contradicts(0.001, there));  // time has stepped back
  prior.accept(0.06, there);
  EXPECT_FALSE(prior.contradicts(0.07, here));  // it does jump
}

TEST(MotionPrior, MeasuresSpeedWhereTheMarkersAre) {
  // A target 0.4 m from the origin of its frame begins to turn on the spot, slower than it may.
  const Vec3 centre(0.4, 0.0, 0.0);
  MotionPrior prior(MotionOptions(), centre);
  const auto turned = [&](double angle) {
    Pose X{exp_rotation({0.0, 0.0, angle}), {0.0, 0.0, 1.0}};
    X.p += centre - X.R * centre;
    return X;
  };
  for (int i = 0; i < 6; ++i) prior.accept(i / 60.0, turned(0.0));
  EXPECT_FALSE(prior.contradicts(6 / 60.0, turned(5.5 / 60.0)));
  EXPECT_TRUE(prior.contradicts(6 / 60.0, turned(9.0 / 60.0)));
}

}  // namespace
}  // namespace mocap
}  // namespace anthrob
