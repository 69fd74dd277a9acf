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

}  // namespace
}  // namespace anthrob
