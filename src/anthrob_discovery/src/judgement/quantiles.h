#pragma once

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>

namespace anthrob {
namespace discovery {

/// Standard deviations below which a normally distributed number is with a probability: 1.64 for
/// 0.95.
inline double one_sided_deviations(double probability) {
  return boost::math::quantile(boost::math::normal(), probability);
}

/// Standard deviations to either side within which it is with a probability: 1.96 for 0.95.
inline double two_sided_deviations(double probability) {
  return one_sided_deviations(0.5 * (1.0 + probability));
}

/// By how much the misfit rises at the ends of an interval of one unknown [nat]: half the quantile
/// of a chi-square of one degree of freedom, 1.92 for 0.95.
inline double rise_at_ends(double confidence) {
  return 0.5 * boost::math::quantile(boost::math::chi_squared(1.0), confidence);
}

}  // namespace discovery
}  // namespace anthrob
