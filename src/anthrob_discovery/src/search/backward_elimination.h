#pragma once

#include <optional>

#include "hypotheses/hypotheses.h"
#include "search/gaps.h"

namespace anthrob {
namespace discovery {

/// Checks whether an effect is still needed beside others that were named later, for which it may
/// have stood in.
class BackwardElimination {
 public:
  BackwardElimination(const Hypotheses& hypotheses, const Gaps& gaps)
      : hypotheses_(hypotheses), gaps_(gaps) {}

  /// Fits the model without the effect. @return the fit to the end without it if the effect does
  /// not meet the criteria any more; nothing if it is still needed
  /// @param effect index of the effect in the model   @param candidate index of its candidate
  /// @param gained reduction of the cost when it was named: a fit without it that lacks half of
  /// that is not continued
  std::optional<Tested> without(std::size_t effect, std::size_t candidate, double gained,
                                const Tested& with) const;

 private:
  const Hypotheses& hypotheses_;
  const Gaps& gaps_;
};

}  // namespace discovery
}  // namespace anthrob
