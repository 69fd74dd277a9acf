#pragma once

#include <optional>

#include "anthrob_calib/discovery/judge.h"
#include "anthrob_calib/discovery/model_fit.h"

namespace anthrob {
namespace discovery {

/// How far fits are taken: friction makes valleys rugged, and no model may be judged for having
/// been left half way down.
class Settling {
 public:
  /// @param judge of what is fitted
  Settling(const Evaluator& evaluator, const ModelFit& fit, const Judge& judge)
      : evaluator_(evaluator), fit_(fit), judge_(judge) {}

  /// From a variant, rough steps first. @throws NotSimulated
  Fitted settled(const Variant& variant, std::vector<Unknown> unknowns) const;
  /// To the end. What was missing has led ordinary parameters astray, and friction does not let
  /// them all find back: with what is found, a fit from the given parameters mostly ends lower.
  Fitted to_the_end(const Fitted& fitted) const;
  /// The same; nothing if it is above a level both where it is and, after rough steps, from the
  /// given parameters.
  std::optional<Fitted> to_the_end_within_reach(const Fitted& fitted, double level) const;
  /// From where a fit is; but only roughly, unless that brings the cost below a level.
  /// @return whether it did
  bool settle_within_reach(Fitted& fitted, double level) const;

  /// What another round may still bring where a fit to the end has ended [nat].
  double left_open(const Fitted& fitted) const;

 private:
  void settle(Fitted& fitted) const;
  bool clearly_misses(const Fitted& fitted) const;
  Fitted rough(const Variant& variant, std::vector<Unknown> unknowns) const;
  std::optional<Fitted> roughly_from_given(const Fitted& fitted) const;
  void finish(Fitted& fitted) const;

  const Evaluator& evaluator_;
  const ModelFit& fit_;
  const Judge& judge_;
};

}  // namespace discovery
}  // namespace anthrob
