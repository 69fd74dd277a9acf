#pragma once

#include <vector>

#include "core/types.h"

namespace anthrob {
namespace mocap {

/// A sphere that shines evenly, as a retro-reflective marker does; brightness 0 hides what is
/// behind.
struct Sphere {
  Vec3 p = Vec3::Zero();    ///< in the rectified left frame [m]
  double radius = 0.008;    ///< [m]
  double brightness = 180;  ///< grey levels above the background
};

/// What the cameras see at one instant.
struct Scene {
  std::vector<Sphere> spheres;
};

}  // namespace mocap
}  // namespace anthrob
