#pragma once

#include "anthrob_calib/discovery/gaps.h"
#include "anthrob_calib/discovery/workbench.h"

namespace anthrob {
namespace discovery {

/// The last decision between two effects. The short list was fitted roughly, from where the model
/// without them had gone astray, and a false one may be lower there. So the first of the list is
/// fitted to the end and, if another effect brings half of what it does, that one, too, unless it
/// is left far behind; and those two are judged against each other.
class RunOff {
 public:
  RunOff(const Workbench& bench, const Gaps& gaps) : bench_(bench), gaps_(gaps) {}

  /// Afterwards the first of the list is fitted to the end, with the evidence of that. The other
  /// one is first if it is more likely in the end and earns its place then. What the two have of
  /// the probability is shared by how likely they are in the end; what was left far behind has
  /// nothing. Other places of the beaten effect go with it, but not one that was more likely, nor
  /// one that only says more at the winner's place. A third law may be more probable than what is
  /// first now: it was not fitted to the end. If the other one is more likely but does not
  /// earn its place, all stays as it was.
  /// @param base fitted without them
  void decide(const Tested& base, ShortList& list) const;

 private:
  /// Its index; 0: none.
  std::size_t challenger(const Tested& base, const ShortList& list) const;
  /// As it was if it cannot be simulated there.
  /// @return whether it gets anywhere near a level of cost; it is not finished if not
  bool finish(Named& named, double level) const;
  double share_of_better(const Tested& base, const ShortList& end) const;

  const Workbench& bench_;
  const Gaps& gaps_;
};

}  // namespace discovery
}  // namespace anthrob
