#pragma once

#include <optional>
#include <vector>

#include "anthrob_recording/series.h"
#include "options/measurement.h"

namespace anthrob {
namespace discovery {

/// A quantity that was measured, and what it must be but for a constant, a factor and a lag.
struct LaggingPair {
  Series measured, expected;
};

/// How all measured series lag behind.
struct LagFit {
  double late = 0.0, sigma = 0.0;  ///< [s]
  double squares = 0.0;            ///< left, over those of each pair's own variance
};

/// Least squares over lags of up to `longest` [s] to either side: the best of a grid, then steps of
/// Gauss and Newton. The error is that of the jackknife over blocks of time.
std::optional<LagFit> fit_lag(const std::vector<LaggingPair>& pairs, double longest,
                              const ClockFitOptions& options);

/// The same of filters of first order, whose time constant is `late`; it is searched only.
std::optional<LagFit> fit_filter(const std::vector<LaggingPair>& pairs, double longest,
                                 const ClockFitOptions& options);

}  // namespace discovery
}  // namespace anthrob
