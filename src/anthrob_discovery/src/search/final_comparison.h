#pragma once

#include "hypotheses/hypotheses.h"
#include "search/gaps.h"

namespace anthrob {
namespace discovery {

/// The final decision between the first of a short list and its challengers. The list was fitted
/// roughly, starting from a model without them whose parameters had gone astray, where a false
/// effect may look better. Therefore the first of the list is fitted to the end. So is the best
/// other law that brings at least half as much, unless it is left far behind, and the two are
/// judged against each other; then the law that was better and the same law at another place. A
/// challenger that can no longer reach the cost of the first is judged as it is.
class FinalComparison {
 public:
  FinalComparison(const Hypotheses& hypotheses, const Gaps& gaps)
      : hypotheses_(hypotheses), gaps_(gaps) {}

  /// Afterwards the first of the list is fitted to the end and has the evidence of that fit.
  /// - A challenger becomes first if it is then more likely and meets the criteria. If it is more
  /// likely, but does not meet them, order and probabilities stay.
  /// - The two share their probability by how likely they are in the end; one that was left far
  /// behind keeps none. Other places of a beaten law give theirs up to the two, except one that was
  /// more likely, or one that only says more at the winner's place.
  /// - A third law may now be more probable than the first one; it was not fitted to the end.
  /// @param base fitted without them
  void decide(const Tested& base, ShortList& list) const;

 private:
  const FinalComparisonOptions& options() const {
    return hypotheses_.options.search.final_comparison;
  }
  enum class Challenger { kOtherLaw, kOtherPlace };
  /// Compares the first of the list, which is fitted to the end, with a challenger.
  /// @param level cost below which a rough fit comes near
  void compare(const Tested& base, Challenger kind, double level, ShortList& list) const;
  bool may_challenge(const Candidate& other, const Candidate& first, Challenger kind) const;
  /// @return index of the effect to compare with the first; 0: none
  std::size_t challenger(Challenger kind, double level, const ShortList& list) const;
  /// Fits to the end, or until a rival's cost is out of reach; unchanged if that cannot be
  /// simulated.
  /// @return whether it comes near a level of cost; otherwise it is not fitted to the end
  bool finish(FittedCandidate& named, double level, double rival) const;
  double share_of_better(const Tested& base, const ShortList& end) const;

  const Hypotheses& hypotheses_;
  const Gaps& gaps_;
};

}  // namespace discovery
}  // namespace anthrob
