#pragma once

#include <Eigen/Core>
#include <set>
#include <vector>

#include "anthrob_calib/discovery/search/excluded_places.h"
#include "anthrob_calib/discovery/search/gaps.h"
#include "anthrob_calib/discovery/search/named_effect.h"
#include "anthrob_calib/discovery/search/search_setup.h"

namespace anthrob {
namespace discovery {

/// The model as a search has it now: the given one with its ordinary parameters fitted, and with
/// the effects that were named so far.
struct WorkingModel {
  /// @param setup must outlive the model
  explicit WorkingModel(const SearchSetup& setup);

  bool has_room() const;  ///< for another effect (--max-effects)
  bool is_named(std::size_t candidate) const;
  /// Whether a candidate is not named, and its law not given up at its muscle, joint or body: what
  /// stood in for another law at one point of a muscle would do so at the next.
  bool may_be_named(std::size_t candidate) const;
  std::vector<std::size_t> accepted() const;  ///< candidates of the named effects, in their order

  /// Makes the model, as long as no effect is named, the one with which all effects are compared.
  void compare_with_this(Answer& answer);
  /// Takes out a named effect. @param without the model fitted without it
  void remove(std::size_t e, Tested without);
  /// To be called when the model has another set of effects: all candidates are considered again.
  /// @param candidate that was named or taken out
  void forget_refusals(const Candidate& candidate, Answer& answer);
  /// charge_spoilt_channels() of the named effects.
  /// @param with_all the model with all of them   @return whether any effect is charged
  bool charge_for_spoilt_channels(const Tested& with_all);
  /// Notes which shape parameters are at the end of their range.
  void note_limits();

  Tested base;                              ///< as it is now
  Tested recalibrated;                      ///< without effects
  Eigen::VectorXf given_train, given_test;  ///< residuals of the model as it was given
  std::vector<NamedEffect> named;           ///< in the order of the model
  Gaps gaps;
  ExcludedPlaces excluded;
  std::set<std::size_t> given_up;  ///< candidates that were named and dropped as improbable

 private:
  const SearchSetup& setup_;
};

}  // namespace discovery
}  // namespace anthrob
