#pragma once

#include <Eigen/Core>
#include <set>
#include <vector>

#include "hypotheses/hypotheses.h"
#include "search/excluded_places.h"
#include "search/gaps.h"
#include "search/named_effect.h"
#include "search/search_result.h"

namespace anthrob {
namespace discovery {

/// The model as a search has it now: the given one with its ordinary parameters fitted, and with
/// the effects that were named so far.
struct WorkingModel {
  /// @param hypotheses must outlive the model   @param most_effects that may be named
  WorkingModel(const Hypotheses& hypotheses, Tested recalibrated_model, int most_effects);

  bool has_room() const;  ///< for another effect (--max-effects)
  bool is_named(std::size_t candidate) const;
  /// Whether a candidate is not named, and its law not given up at its muscle, joint or body: what
  /// stood in for another law at one point of a muscle would do so at the next.
  bool may_be_named(std::size_t candidate) const;
  std::vector<std::size_t> accepted() const;  ///< candidates of the named effects, in their order

  /// Makes the model, as long as no effect is named, the one with which all effects are compared.
  void compare_with_this();
  /// Takes out a named effect. @param without the model fitted without it
  void remove(std::size_t e, Tested without);
  /// To be called when the model has another set of effects: all candidates are considered again.
  /// @param candidate that was named or taken out
  void forget_refusals(const Candidate& candidate);
  /// charge_spoilt_channels() of the named effects.
  /// @param with_all the model with all of them   @return whether any effect is charged
  bool charge_for_spoilt_channels(const Tested& with_all);
  /// Notes which shape parameters are at the end of their range.
  void note_limits();

  Tested base;                     ///< as it is now
  Tested recalibrated;             ///< without effects
  std::vector<NamedEffect> named;  ///< in the order of the model
  Gaps gaps;
  ExcludedPlaces excluded;
  SearchRecord record;
  std::set<std::size_t> given_up;  ///< candidates that were named and dropped as improbable

 private:
  const Hypotheses& hypotheses_;
  std::size_t most_effects_;
};

}  // namespace discovery
}  // namespace anthrob
