#pragma once

#include <optional>

#include "anthrob_calib/discovery/screening.h"
#include "anthrob_calib/discovery/workbench.h"

namespace anthrob {
namespace discovery {

/// Two laws at one place may be one of more sizes: friction that differs by direction is friction
/// and a constant torque, too.
class CommonLaw {
 public:
  /// An effect in a fit: its index in there, and which candidate it is.
  struct Part {
    std::size_t effect, candidate;
  };

  CommonLaw(const Workbench& bench, Screening& screening) : bench_(bench), screening_(screening) {}

  /// Whether a candidate may say alone what two others say.
  bool may_be(std::size_t law, std::size_t one, std::size_t other) const;
  /// That candidate, fitted to the end instead of two effects, and its odds against them.
  /// @param with both of them, fitted to the end
  /// @return nothing if it is out of reach of them
  std::optional<Naming::Odds> odds(std::size_t law, const Tested& with, const Part& earlier,
                                   const Part& later) const;

 private:
  const Workbench& bench_;
  Screening& screening_;
};

}  // namespace discovery
}  // namespace anthrob
