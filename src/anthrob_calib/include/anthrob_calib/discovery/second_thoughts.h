#pragma once

#include <optional>

#include "anthrob_calib/discovery/gaps.h"
#include "anthrob_calib/discovery/naming.h"
#include "anthrob_calib/discovery/settling.h"

namespace anthrob {
namespace discovery {

/// Whether an effect that was named before others were is needed beside them: it may have stood in
/// for them.
class SecondThoughts {
 public:
  SecondThoughts(const Evaluator& evaluator, const ModelFit& train, const ModelFit& test,
                 const std::vector<Candidate>& candidates, const Naming& naming, const Gaps& gaps,
                 const Settling& settling)
      : evaluator_(evaluator),
        train_(train),
        test_(test),
        candidates_(candidates),
        naming_(naming),
        gaps_(gaps),
        settling_(settling) {}

  /// Fitted to the end without it, if it does not earn its place; else nothing.
  /// @param effect its index in the model   @param candidate which it is
  /// @param gained of the cost when it came in: what lacks half of that without it is not fitted
  /// further
  std::optional<Tested> without(std::size_t effect, std::size_t candidate, double gained,
                                const Tested& with) const;

 private:
  const Evaluator& evaluator_;
  const ModelFit &train_, &test_;
  const std::vector<Candidate>& candidates_;
  const Naming& naming_;
  const Gaps& gaps_;
  const Settling& settling_;
};

}  // namespace discovery
}  // namespace anthrob
