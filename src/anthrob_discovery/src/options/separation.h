#pragma once

#include <cstddef>

#include "options/share.h"

namespace anthrob {
namespace discovery {

/// The recording that tells two explanations apart.
struct SeparationOptions {
  int moments = 200;             ///< of a recording, among which postures are chosen
  std::size_t postures = 12;     ///< that are tried
  std::size_t targets = 6;       ///< that are kept
  double tighter = 0.35;         ///< [rad] all spindles wound up further
  Share little = 0.1;            ///< of the way to a posture
  double leg = 2.5;              ///< [s] from command to command
  double command_period = 0.01;  ///< [s] from row to row of the recording that is simulated

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("moments", options.moments);
    visit("postures", options.postures);
    visit("targets", options.targets);
    visit("tighter", options.tighter);
    visit("little", options.little);
    visit("leg", options.leg);
    visit("command_period", options.command_period);
  }
};

}  // namespace discovery
}  // namespace anthrob
