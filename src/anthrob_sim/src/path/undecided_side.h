#pragma once

#include <optional>
#include <utility>

#include "anthrob_sim/path/wrapping_surface.h"

namespace anthrob {

/// Whether rounding decides on which side of a surface a tendon comes to lie: a straight line
/// through the axis of a cylinder or the centre of a sphere is equally far from either. Chi decides
/// for meshes.
/// @param before, after the neighbouring points, in the frame of the surface's body [m]
/// @return lengths of the tendon over the surface on one side and on the other [m]; none where the
/// points decide
std::optional<std::pair<double, double>> undecided_side(const WrappingSurface& surface,
                                                        const Vec3& before, const Vec3& after);

}  // namespace anthrob
