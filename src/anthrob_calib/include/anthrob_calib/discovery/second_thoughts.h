#pragma once

#include <optional>

#include "anthrob_calib/discovery/gaps.h"
#include "anthrob_calib/discovery/workbench.h"

namespace anthrob {
namespace discovery {

/// Whether an effect that was named before others were is needed beside them: it may have stood in
/// for them.
class SecondThoughts {
 public:
  SecondThoughts(const Workbench& bench, const Gaps& gaps) : bench_(bench), gaps_(gaps) {}

  /// Fitted to the end without it, if it does not earn its place; else nothing.
  /// @param effect its index in the model   @param candidate which it is
  /// @param gained of the cost when it came in: what lacks half of that without it is not fitted
  /// further
  std::optional<Tested> without(std::size_t effect, std::size_t candidate, double gained,
                                const Tested& with) const;

 private:
  const Workbench& bench_;
  const Gaps& gaps_;
};

}  // namespace discovery
}  // namespace anthrob
