#pragma once

#include <cstddef>

#include "options/share.h"

namespace anthrob {
namespace discovery {

/// Curves of residuals over measured quantities.
struct DependenceOptions {
  std::size_t steps = 9;           ///< of a curve
  std::size_t levels = 3;          ///< of a second quantity
  std::size_t bins_per_step = 10;  ///< on average, fewest
  double fewest_bins = 2.0;        ///< of a mean
  Share still = 0.02;    ///< of the largest speed, below which the sign of a speed means nothing
  Share better = 0.02;   ///< by which a quantity must predict more than another
  Share telling = 0.05;  ///< of the squared residual; a smaller one says nothing
  double wrap_angle = 0.05;  ///< [rad] by which the wrap angle of a tendon changes, at least

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("steps", options.steps);
    visit("levels", options.levels);
    visit("bins_per_step", options.bins_per_step);
    visit("fewest_bins", options.fewest_bins);
    visit("still", options.still);
    visit("better", options.better);
    visit("telling", options.telling);
    visit("wrap_angle", options.wrap_angle);
  }
};

/// Gaps of a simulation that is fed with measured values.
struct SeamOptions {
  Share gone = 0.5;  ///< of what is beyond the noise: less is left where the cause was cut off
  /// times the gap before postures are imposed: an imposed posture does not give way to a wrong
  /// force
  double misleading = 2.0;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("gone", options.gone);
    visit("misleading", options.misleading);
  }
};

/// Where recordings and model disagree.
struct DiagnosisOptions {
  double too_good = 0.3;     ///< [floors] rounding of the coarsest sensors alone leaves more
  std::size_t examples = 3;  ///< channels that are drawn
  std::size_t curves = 3;    ///< dependences that are drawn
  DependenceOptions dependence;
  SeamOptions seams;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("too_good", options.too_good);
    visit("examples", options.examples);
    visit("curves", options.curves);
    visit("dependence", options.dependence);
    visit("seams", options.seams);
  }
};

}  // namespace discovery
}  // namespace anthrob
