#include "anthrob_sim/path/wrapping_surface.h"

#include <algorithm>
#include <map>

#include "path/cylinder.h"
#include "path/mesh_surface.h"
#include "path/sphere.h"
#include "path/surface_types.h"

namespace anthrob {

namespace {
using SurfaceFactory = std::shared_ptr<const WrappingSurface> (*)(const ConfigNode&, const Pose&,
                                                                  const MeshFiles&);

/// For surfaces that need no file.
template <std::shared_ptr<const WrappingSurface> (*kLoad)(const ConfigNode&, const Pose&)>
std::shared_ptr<const WrappingSurface> without_files(const ConfigNode& node, const Pose& X_BL,
                                                     const MeshFiles&) {
  return kLoad(node, X_BL);
}

// A new surface: one file, one line here.
const std::map<std::string, SurfaceFactory>& factories() {
  static const std::map<std::string, SurfaceFactory> kFactories = {
      {"cylinder", &without_files<&Cylinder::load>},
      {"mesh", &MeshSurface::load},
      {"sphere", &without_files<&Sphere::load>},
  };
  return kFactories;
}
}  // namespace

std::shared_ptr<const WrappingSurface> make_wrapping_surface(const std::string& type,
                                                             const ConfigNode& node,
                                                             const Pose& X_BL,
                                                             const MeshFiles& files) {
  const auto it = factories().find(type);
  if (it == factories().end())
    node.fail("unknown wrapping surface; known: " + wrapping_surface_types());
  return it->second(node, X_BL, files);
}

std::string wrapping_surface_types() {
  std::string names;
  for (const auto& entry : factories()) names += (names.empty() ? "" : ", ") + entry.first;
  return names;
}

void set_straight(const Vec3& before, const Vec3& after, const Vec3& point, WrapContact& contact) {
  const Vec3 line = after - before;
  const double length = line.norm();
  // Coincident points pull nowhere; any direction serves.
  const Vec3 direction = length > 0.0 ? Vec3(line / length) : Vec3(Vec3::UnitX());
  const double s = std::clamp(direction.dot(point - before), 0.0, length);
  contact = WrapContact();
  contact.entry = contact.exit = before + s * direction;
  contact.direction_in = contact.direction_out = direction;
  contact.pull_in = contact.pull_out = direction;
  contact.length_in = s;
  contact.length_out = length - s;
}

}  // namespace anthrob
