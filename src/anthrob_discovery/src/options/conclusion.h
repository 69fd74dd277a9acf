#pragma once

#include "options/share.h"

namespace anthrob {
namespace discovery {

/// The verdict.
struct ConclusionOptions {
  Share most_remains = 0.45;  ///< of the squared gap that an answer may leave

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("most_remains", options.most_remains);
  }
};

}  // namespace discovery
}  // namespace anthrob
