// The bones that scripts/make_bones.py wrote: insertions on their surface, tendons as long as Table
// C.9 says.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "anthrob_core/testing/content.h"
#include "anthrob_sim/simulation.h"
#include "path/mesh_file.h"
#include "support.h"

namespace anthrob {
namespace {

using testing_support::config;

/// Nearest point of a triangle, by clamping barycentric coordinates region by region.
Vec3 nearest(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto on_side = [&](const Vec3& u, const Vec3& v) {
    const double t = std::clamp((p - u).dot(v - u) / (v - u).squaredNorm(), 0.0, 1.0);
    return Vec3(u + t * (v - u));
  };
  const Vec3 normal = (b - a).cross(c - a).normalized();
  const Vec3 foot = p - normal * normal.dot(p - a);
  const bool inside = normal.dot((b - a).cross(foot - a)) >= 0 &&
                      normal.dot((c - b).cross(foot - b)) >= 0 &&
                      normal.dot((a - c).cross(foot - c)) >= 0;
  if (inside) return foot;
  Vec3 best = on_side(a, b);
  for (const Vec3& x : {on_side(b, c), on_side(c, a)}) {
    if ((x - p).norm() < (best - p).norm()) best = x;
  }
  return best;
}

TEST(Bones, AreWhatTheirGeneratorWrites) {
  const std::filesystem::path folder = config("");
  const auto out =
      std::filesystem::temp_directory_path() / ("anthrob_bones_" + std::to_string(getpid()));
  const std::string command = "/usr/bin/python3 " + (folder / "../scripts/make_bones.py").string() +
                              " " + out.string() + " > /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  for (const char* bone : {"humerus.stl", "scapula.stl"}) {
    const std::string written = content(out / bone);
    EXPECT_GT(written.size(), 100000u) << bone;
    // Byte by byte, but not printed: a bone is 300 kB.
    EXPECT_TRUE(written == content(folder / "anthrob/meshes" / bone)) << bone;
  }
  std::filesystem::remove_all(out);
}

TEST(Bones, AreSoundAndOfTheRightSize) {
  for (const char* bone : {"humerus", "scapula"}) {
    const TriangleMesh mesh = read_mesh(config(std::string("anthrob/meshes/") + bone + ".stl"));
    EXPECT_TRUE(mesh_oddities(mesh).empty()) << bone << ": " << mesh_oddities(mesh)[0];
    EXPECT_GT(mesh.vertices.size(), 2500u) << bone;
    EXPECT_LT(mesh.vertices.size(), 3500u) << bone;
  }
}

TEST(Bones, InsertionsLieOnTheSurface) {
  const TriangleMesh bone = read_mesh(config("anthrob/meshes/humerus.stl"));
  const std::map<std::string, Vec3> insertions = {{"deltoids", {-0.0090, 0.1475, -0.0090}},
                                                  {"supraspinatus", {-0.0098, 0.1922, -0.0171}},
                                                  {"infraspinatus", {-0.0106, 0.1820, -0.0202}},
                                                  {"teres_minor", {-0.0091, 0.1702, -0.0147}},
                                                  {"teres_major", {-0.0202, 0.1820, -0.0106}},
                                                  {"pectoralis_major", {-0.0108, 0.1520, 0.0108}}};
  for (const auto& [muscle, p] : insertions) {
    double distance = 1.0, side = 0.0;
    for (const auto& f : bone.facets) {
      const Vec3 &a = bone.vertices[f[0]], &b = bone.vertices[f[1]], &c = bone.vertices[f[2]];
      const Vec3 x = nearest(p, a, b, c);
      if ((p - x).norm() >= distance) continue;
      distance = (p - x).norm();
      side = (b - a).cross(c - a).dot(p - x);
    }
    EXPECT_LT(distance, 0.0003) << muscle;
    EXPECT_GT(side, 0.0) << muscle << " lies inside the bone";
  }
}

TEST(Bones, TendonsAreAsLongAtRestAsTableC9Says) {
  const Simulation sim(load_robot_model(config("anthrob/model_III.yaml")));
  // Two rest lengths of the table are shorter than any way round a bone: than the straight line.
  const std::map<std::string, double> stretched = {{"lateral_deltoid", 0.52},
                                                   {"pectoralis_major", 0.76}};
  for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
    const std::string& name = sim.muscle(m).model().name;
    const auto it = stretched.find(name);
    EXPECT_NEAR(1e3 * sim.muscle(m).expansion(), it == stretched.end() ? 0.0 : it->second, 0.2)
        << name;
  }
}

}  // namespace
}  // namespace anthrob
