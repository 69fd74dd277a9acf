#pragma once

#include <cmath>

#include "anthrob_core/config_node.h"
#include "core/types.h"

namespace anthrob {
namespace mocap {

/// The orientation [w, x, y, z] of a file.
/// @throws BadInput if its norm is not 1 to a thousandth
inline Quat unit_quaternion(const ConfigNode& node) {
  const std::vector<double> v = node.as_numbers(4, "1");
  const Quat q(v[0], v[1], v[2], v[3]);
  if (!(std::abs(q.norm() - 1.0) <= 1e-3)) node.fail_expected("a unit quaternion [w, x, y, z]");
  return q.normalized();
}

}  // namespace mocap
}  // namespace anthrob
