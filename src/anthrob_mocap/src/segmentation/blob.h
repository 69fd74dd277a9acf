#pragma once

#include <cmath>

#include "core/types.h"

namespace anthrob {
namespace mocap {

/// A bright region of an image that can be a marker.
struct Blob {
  Vec2 centre = Vec2::Zero();  ///< grey-weighted centroid [pixel], (0, 0) is a pixel's centre
  double area = 0.0;           ///< [pixel]
  double axis_ratio = 1.0;     ///< longest to shortest standard deviation, >= 1
  double fill = 1.0;           ///< area by that of the ellipse of the same moments; 1: an ellipse

  double radius() const { return std::sqrt(area / M_PI); }
};

}  // namespace mocap
}  // namespace anthrob
