#pragma once

#include <limits>
#include <optional>
#include <string>

#include "health/history.h"

namespace anthrob {
namespace health {

/// What became of a figure since the first tests.
struct Trend {
  double normal = 0.0;   ///< mean of the first tests
  double now = 0.0;      ///< median of the last three
  double scatter = 0.0;  ///< standard deviation from test to test
  double limit = 0.0;    ///< change from normal that is too much
  double per_day = 0.0;
  bool is_certain = false;     ///< whether the change is more than scatter
  std::optional<double> days;  ///< until the limit is reached; 0: it is; none: not by this trend
  double change() const { return now - normal; }
  /// The smallest change that would be certain.
  double visible = std::numeric_limits<double>::infinity();
};

/// @return nothing if there are fewer than options.fewest_tests
std::optional<Trend> trend_of(Quantity quantity, const History::Series& series,
                              const HealthOptions& options);

/// The change that is too much.
double limit_of(Quantity quantity, double normal);

}  // namespace health
}  // namespace anthrob
