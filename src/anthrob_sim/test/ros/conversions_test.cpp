// What the node draws: wrapping surfaces as RViz can show them, where the muscles meet them.
#include "anthrob_sim/conversions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/solved_path.h"
#include "support.h"

namespace anthrob {
namespace {

using testing_support::config;
using visualization_msgs::Marker;

Vec3 vector_of(const geometry_msgs::Point& p) {
  return {p.x, p.y, p.z};
}

std::vector<Marker> markers_of(const std::string& model) {
  return surface_markers(*load_robot_model(config(model))).markers;
}

TEST(MuscleChannels, AMuscleWithoutForceSensorTakesNoForces) {
  const auto channels = muscle_channels(*load_robot_model(config("anthrob/model_II_hand.yaml")));
  ASSERT_EQ(channels.size(), 13u);
  const auto takes = [](bool force) {
    return std::array<bool, ecu::kModeCount>{true, true, true, force};
  };
  for (std::size_t m = 0; m < 13; ++m) {
    EXPECT_EQ(channels[m].modes, takes(m < 11)) << channels[m].name;
  }
  const auto& hand = channels[12];
  EXPECT_EQ(hand.name, "hand_antagonist");
  EXPECT_EQ(hand.highest, (std::array<double, ecu::kModeCount>{6.0, 15.0, 1.0, 0.0}));
}

TEST(MuscleStates, AMuscleWithoutForceSensorHasNoForce) {
  const Simulation sim(load_robot_model(config("anthrob/model_II_hand.yaml")));
  const ecu::Supervisor supervisor(muscle_channels(sim.model()), {});
  const auto states = muscle_states(sim, supervisor, ros::Time(1.0));
  ASSERT_EQ(states.force.size(), 13u);
  for (std::size_t m = 0; m < 13; ++m) {
    EXPECT_EQ(std::isnan(states.force[m]), m >= 11) << states.name[m];
  }
}

TEST(SurfaceMarkers, HaveAShapeAndASize) {
  for (const char* model :
       {"anthrob/model_II.yaml", "anthrob/model_III.yaml", "torso_100/model_II.yaml"}) {
    const auto markers = markers_of(model);
    EXPECT_FALSE(markers.empty()) << model;
    for (const Marker& marker : markers) {
      EXPECT_TRUE(marker.type == Marker::CYLINDER || marker.type == Marker::SPHERE ||
                  marker.type == Marker::TRIANGLE_LIST)
          << model << ": type " << marker.type;
      EXPECT_GT(marker.scale.x * marker.scale.y * marker.scale.z, 0.0) << model;
      const auto& q = marker.pose.orientation;
      EXPECT_NEAR(Quat(q.w, q.x, q.y, q.z).norm(), 1.0, 1e-9);
    }
  }
}

TEST(SurfaceMarkers, MeshesAreClosedAndSeenFromOutside) {
  int meshes = 0;
  for (const Marker& marker : markers_of("anthrob/model_III.yaml")) {
    if (marker.type != Marker::TRIANGLE_LIST) continue;
    ++meshes;
    ASSERT_FALSE(marker.points.empty());
    ASSERT_EQ(marker.points.size() % 3, 0u);
    // The area vectors of a closed surface add up to nothing; the volume is that of a bone.
    Vec3 sum = Vec3::Zero();
    double area = 0.0, volume = 0.0;
    for (std::size_t i = 0; i < marker.points.size(); i += 3) {
      const Vec3 a = vector_of(marker.points[i]), b = vector_of(marker.points[i + 1]),
                 c = vector_of(marker.points[i + 2]);
      const Vec3 normal = 0.5 * (b - a).cross(c - a);
      sum += normal;
      area += normal.norm();
      volume += a.dot(normal) / 3.0;
    }
    EXPECT_LT(sum.norm(), 1e-9 * area);
    EXPECT_GT(volume, 1e-6);
    EXPECT_LT(volume, 1e-2);
  }
  EXPECT_GT(meshes, 0);
}

TEST(SurfaceMarkers, MeshesLieWhereMusclesTouchThem) {
  const auto model = load_robot_model(config("anthrob/model_III.yaml"));
  Simulation sim(model);
  const auto markers = surface_markers(*model).markers;
  int touching = 0;
  std::size_t next = 0;
  for (std::size_t m = 0; m < model->muscles.size(); ++m) {
    for (const SolvedContact& contact : solved_path(sim, static_cast<int>(m)).contacts) {
      const Marker& marker = markers.at(next++);
      if (marker.type != Marker::TRIANGLE_LIST || !contact.touching) continue;
      ++touching;
      const auto& q = marker.pose.orientation;
      const Pose X_LM{Quat(q.w, q.x, q.y, q.z).toRotationMatrix(), vector_of(marker.pose.position)};
      const Pose X_WM = sim.link_pose(model->skeleton->find_frame(marker.header.frame_id)) * X_LM;
      // On a convex body: in the plane of one facet, above none.
      double height = -1.0;
      for (std::size_t k = 0; k < marker.points.size(); k += 3) {
        const Vec3 corner = X_WM * vector_of(marker.points[k]);
        const Vec3 normal = (X_WM * vector_of(marker.points[k + 1]) - corner)
                                .cross(X_WM * vector_of(marker.points[k + 2]) - corner)
                                .normalized();
        height = std::max(height, normal.dot(contact.entry_W - corner));
      }
      EXPECT_NEAR(height, 0.0, 1e-6) << model->muscles[m].name;
    }
  }
  EXPECT_GT(touching, 0);
}

/// Points of a tendon, put where the links are now.
std::vector<Vec3> placed(const anthrob_msgs::TendonPath& path, const Simulation& sim) {
  const SkeletonModel& skeleton = *sim.model().skeleton;
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < path.point.size(); ++k) {
    points.push_back(sim.link_pose(skeleton.find_frame(path.link.at(k))) *
                     vector_of(path.point[k]));
  }
  return points;
}

std::vector<double> bent(const Simulation& sim) {
  std::vector<double> q = sim.configuration();
  for (const JointModel& joint : sim.model().skeleton->joints) {
    if (joint.type == JointType::kBall) {
      const Quat turned(Eigen::AngleAxisd(0.5, Vec3(1.0, 0.5, 0.2).normalized()));
      const double values[] = {turned.w(), turned.x(), turned.y(), turned.z()};
      std::copy(values, values + 4, q.begin() + joint.position_offset);
    } else {
      q[joint.position_offset] += 0.7;
    }
  }
  return q;
}

TEST(TendonPaths, PlacedByLinksTheyAreTheMarkers) {
  for (const char* file :
       {"anthrob/model_II.yaml", "anthrob/model_III.yaml", "torso_100/model_II.yaml"}) {
    Simulation sim(load_robot_model(config(file)));
    const std::vector<double> positions(sim.muscle_count(), 0.0);
    for (const bool moved : {false, true}) {
      if (moved) sim.place(bent(sim), positions);
      const auto forces = spring_tensions(sim);
      const auto markers = muscle_markers(sim, forces, ros::Time(1.0)).markers;
      const auto paths = tendon_paths(sim, forces, 0.0, ros::Time(1.0)).muscles;
      ASSERT_EQ(paths.size(), markers.size());
      for (std::size_t m = 0; m < paths.size(); ++m) {
        EXPECT_EQ(paths[m].name, markers[m].ns);
        const auto points = placed(paths[m], sim);
        ASSERT_EQ(points.size(), markers[m].points.size());
        for (std::size_t k = 0; k < points.size(); ++k) {
          EXPECT_LT((points[k] - vector_of(markers[m].points[k])).norm(), 1e-9)
              << file << ": " << paths[m].name << " point " << k;
        }
      }
    }
  }
}

TEST(TendonPaths, EndsStayAtTheirAnchorsWhileTheArmMoves) {
  Simulation sim(load_robot_model(config("anthrob/model_II.yaml")));
  const auto told = [&] {
    return tendon_paths(sim, spring_tensions(sim), 0.0, ros::Time(1.0)).muscles;
  };
  const auto before = told();
  const Vec3 end_before = placed(before[0], sim).back();
  sim.place(bent(sim), std::vector<double>(sim.muscle_count(), 0.0));
  const auto after = told();
  EXPECT_GT((placed(after[0], sim).back() - end_before).norm(), 0.02);
  for (std::size_t m = 0; m < after.size(); ++m) {
    EXPECT_EQ(after[m].link.front(), before[m].link.front());
    EXPECT_EQ(after[m].link.back(), before[m].link.back());
    EXPECT_EQ(after[m].point.front(), before[m].point.front());
    EXPECT_EQ(after[m].point.back(), before[m].point.back());
  }
  // From the model file: origin and insertion of the lateral deltoid. The base, fixed to the
  // world, is one body with it.
  EXPECT_EQ(after[0].link.front(), "world");
  const Pose X_WBase = sim.link_pose(sim.model().skeleton->find_frame("base"));
  EXPECT_LT((placed(after[0], sim).front() - X_WBase * Vec3(-0.0060, -0.0287, 0.4656)).norm(),
            1e-9);
  EXPECT_EQ(after[0].link.back(), "humerus");
  EXPECT_LT((vector_of(after[0].point.back()) - Vec3(-0.0090, 0.1475, -0.0090)).norm(), 1e-9);
}

TEST(TendonPaths, SlackUpToAForceAndNotWhereNoneIsMeasured) {
  const Simulation sim(load_robot_model(config("anthrob/model_II.yaml")));
  std::vector<double> forces(sim.muscle_count(), 5.0);
  forces[1] = 0.2, forces[2] = NAN;
  const auto paths = tendon_paths(sim, forces, 1.0, ros::Time(3.0));
  EXPECT_EQ(paths.header.stamp, ros::Time(3.0));
  EXPECT_EQ(paths.muscles[0].force, 5.0);
  EXPECT_FALSE(paths.muscles[0].slack);
  EXPECT_TRUE(paths.muscles[1].slack);
  EXPECT_TRUE(std::isnan(paths.muscles[2].force));
  EXPECT_FALSE(paths.muscles[2].slack);
}

}  // namespace
}  // namespace anthrob
