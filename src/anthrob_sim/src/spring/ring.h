#pragma once

#include <cmath>

#include "anthrob_core/config_node.h"

namespace anthrob {

/// Geometry of rubber rings in parallel: from expansion to engineering strain, from stress to
/// tension. Two strands a ring (Figure 7.3):  f = quantity * strands * (pi d^2 / 4) * stress.
struct Ring {
  double rest_length;  ///< l_0, inner diameter [m]
  double area;         ///< of all strands of all rings [m^2]

  double strain(double expansion) const { return expansion > 0.0 ? expansion / rest_length : 0.0; }
  double tension(double stress) const { return stress > 0.0 ? area * stress : 0.0; }
  double volume() const { return area * rest_length; }

  /// Reads `rest_length`, `section_diameter` and `strands`.
  static Ring load(const ConfigNode& node, int quantity) {
    const double l0 = node.number("rest_length", Bounds::fraction(), "m");
    const double d = node.number("section_diameter", Bounds{0.0, 0.1, true, false}, "m");
    const int strands = node.at("strands").as_integer(1, 100);
    return {l0, quantity * strands * 0.25 * M_PI * d * d};
  }
};

}  // namespace anthrob
