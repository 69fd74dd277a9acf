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
/// misfit rises by rise_at_ends(). Found by bisection, on either side the boundary that is nearest
/// to the fit by halving.
std::pair<double, double> flat_range(const ModelFit& fit, const Fitted& fitted,
                                     std::size_t unknown);

}  // namespace discovery
}  // namespace anthrob
