#pragma once

#include <cstddef>
#include <utility>

#include "fit/model_fit.h"

namespace anthrob {
namespace discovery {

/// Whether an unknown, anywhere in its range, would change the residual by less than one standard
/// deviation in all if its slope at the fit went on. Then intervals by slopes tell nothing of it:
/// friction that holds a joint in any case could be larger, but not much smaller.
bool is_flat(const Fitted& fitted, std::size_t unknown, const IntervalOptions& options);

/// 95 % interval of one unknown, the others held where they are, by simulation: as far as the
/// misfit rises by 1.92 nat, half the quantile of a chi-square of one degree of freedom. Found by
/// bisection to 1/1000 of its range, on either side the boundary that is nearest to the fit by
/// halving.
std::pair<double, double> flat_range(const ModelFit& fit, const Fitted& fitted,
                                     std::size_t unknown);

}  // namespace discovery
}  // namespace anthrob
