#pragma once

#include "options/share.h"

namespace anthrob {
namespace discovery {

/// What recordings can show.
struct DetectabilityOptions {
  Share probability = 0.95;  ///< with which an effect of the smallest visible size would be named
  int rounds = 3;            ///< in which a size is made larger
  Share enough = 0.9;        ///< of the evidence that is needed
  double most_doses = 5.0;   ///< [typical sizes] larger ones are unrealistic

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("probability", options.probability);
    visit("rounds", options.rounds);
    visit("enough", options.enough);
    visit("most_doses", options.most_doses);
  }
};

}  // namespace discovery
}  // namespace anthrob
