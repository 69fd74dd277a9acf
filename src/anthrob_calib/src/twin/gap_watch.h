#pragma once

#include <map>
#include <string>
#include <vector>

#include "twin/chain_part.h"
#include "twin/twins.h"

namespace anthrob {
namespace twin {

/// Since when model and robot part, and where.
class GapWatch {
 public:
  /// @param warn [floors] over the second window
  explicit GapWatch(double warn) : warn_(warn) {}

  struct Warning {
    Finding finding;
    Nanoseconds since = 0, now = 0;

    /// "teres_major: 6 floors since 40 s, spring or tendon"
    std::string text() const;
  };

  /// A new report. One whose time is before that of the last begins anew.
  void see(const Channels& channels, const GapReport& report);
  const std::vector<Warning>& warnings() const { return warnings_; }

 private:
  double warn_;
  std::vector<Warning> warnings_;
  Nanoseconds last_ = 0;
};

}  // namespace twin
}  // namespace anthrob
