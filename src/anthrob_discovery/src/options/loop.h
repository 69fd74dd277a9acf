#pragma once

#include "options/share.h"

namespace anthrob {
namespace discovery {

/// Separating recordings of a simulated robot.
struct LoopOptions {
  int most_recordings = 2;  ///< that are made
  Share rival = 0.05;       ///< probability below which a rival is settled
  double tells = 3.0;       ///< [nat] a recording that is expected to tell less is not worth making

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("most_recordings", options.most_recordings);
    visit("rival", options.rival);
    visit("tells", options.tells);
  }
};

}  // namespace discovery
}  // namespace anthrob
