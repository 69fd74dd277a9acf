#pragma once

#include <vector>

#include "options/experiment.h"

namespace anthrob {
namespace discovery {

/// An effort that an axis lacks, averaged over a bin.
struct InertialBin {
  double inertial;   ///< part that is due to acceleration
  double low, high;  ///< between which it is, with that part
};

/// What of a range is left beyond zero: 0 if zero is within it.
inline double beyond_zero(double low, double high) {
  return low > 0.0 ? low : high < 0.0 ? high : 0.0;
}

/// The factor of the inertial parts, at least 0, that leaves least squares of beyond_zero(); 1 if
/// there are none. A convex problem of one unknown, solved by Newton's method within brackets.
double best_factor(const std::vector<InertialBin>& bins, const AxisOptions& options);

}  // namespace discovery
}  // namespace anthrob
