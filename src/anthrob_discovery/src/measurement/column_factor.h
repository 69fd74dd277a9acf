#pragma once

#include <optional>
#include <vector>

#include "options/measurement.h"

namespace anthrob {
namespace discovery {

/// A column as a multiple of what it must be.
struct ColumnFactor {
  double factor = 1.0;                 ///< one that a sign or a unit makes
  double measured = 1.0, sigma = 0.0;  ///< by least squares
};

/// @param expected, recorded values at the same moments   @param factors that units make, besides 1
/// @param near share by which a multiple may be off; a sign may by options.near
/// @return nothing where the two are hardly correlated, or physics may make the multiple
std::optional<ColumnFactor> column_factor(const std::vector<double>& expected,
                                          const std::vector<double>& recorded,
                                          const std::vector<double>& factors, double near,
                                          const ColumnOptions& options);

}  // namespace discovery
}  // namespace anthrob
