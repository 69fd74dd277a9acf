#pragma once

#include <cmath>
#include <optional>

#include "fit/model_fit.h"
#include "judgement/judge.h"

namespace anthrob {
namespace discovery {

/// Decides how far fits are taken. Friction makes the cost rugged, and no model should lose because
/// its fit was stopped too early.
class Convergence {
 public:
  /// @param judge of what is fitted
  Convergence(const Evaluator& evaluator, const ModelFit& fit, const Judge& judge)
      : evaluator_(evaluator), fit_(fit), judge_(judge) {}

  /// Fits from a variant, with rough steps first. @throws NotSimulated
  Fitted converged(const Variant& variant, std::vector<Unknown> unknowns) const;
  /// Fits to the end, also once more from the given parameters: what was missing has led the
  /// ordinary parameters astray, and friction does not let them all find back; and from another
  /// size of the effects, if that clearly misses and another size does better. A fit from the given
  /// parameters ends early where its first round with better sensitivities leaves it behind.
  /// @return the best fit
  Fitted to_the_end(const Fitted& fitted) const;
  /// The same for a fit that is compared with another one. Rounds end early when they gain so
  /// little that all the rounds there are would not bring it to the other's cost.
  /// @param rival the other's cost
  /// @return nothing if the cost is above `level` both where the fit is and after rough steps from
  /// the given parameters
  std::optional<Fitted> to_the_end_within_reach(const Fitted& fitted, double level,
                                                double rival = HUGE_VAL) const;
  /// Continues a fit from where it is, but only roughly unless that brings the cost below a level.
  /// @return whether it came below the level
  bool converge_within_reach(Fitted& fitted, double level) const;

  /// By how much another round might still reduce the cost of a fit to the end [nat].
  double left_open(const Fitted& fitted) const;

 private:
  const ConvergenceOptions& options() const { return fit_.options().convergence; }
  /// @return whether the cost came below a level, and further rounds might bring it to the rival's
  bool converge(Fitted& fitted, double rival = HUGE_VAL, double level = HUGE_VAL) const;
  bool clearly_misses(const Fitted& fitted) const;
  std::optional<Fitted> roughly_from_given(const Fitted& fitted) const;
  /// @return whether that was better
  bool begin_anew(Fitted& fitted) const;
  void finish(Fitted& fitted, double rival) const;

  const Evaluator& evaluator_;
  const ModelFit& fit_;
  const Judge& judge_;
};

}  // namespace discovery
}  // namespace anthrob
