#pragma once

#include <optional>
#include <string>
#include <vector>

#include "anthrob_ecu/supervisor.h"
#include "anthrob_sim/simulation.h"

namespace anthrob {

/// Driven joints, under the same safety rules as muscles: no effort before enable, none after a
/// stop until it is cleared, and none once commands time out. Each joint counts as an ECU of its
/// own. A stopped joint forgets its effort.
class DrivenJoints {
 public:
  DrivenJoints(const SkeletonModel& skeleton, const ecu::Supervisor::Options& options);

  /// Applies a whole command, or refuses it with a reason: an unknown joint, unequal numbers,
  /// efforts that are not finite, a joint that is stopped, or one that another sender commands.
  ecu::Supervisor::Outcome command(const std::vector<std::string>& names,
                                   const std::vector<double>& efforts, Simulation& sim,
                                   const std::string& sender = "");
  /// Counts and records a command that is refused for a reason of somebody else.
  ecu::Supervisor::Outcome refuse(const std::string& reason);
  /// Removes the effort from stopped joints; to be called after every request to the supervisor.
  void apply(Simulation& sim) const;

  /// Takes enable, disable, stops, and the time.
  ecu::Supervisor& supervisor() { return supervisor_; }
  const ecu::Supervisor& supervisor() const { return supervisor_; }
  /// Reason of the last refused command; empty if none was refused.
  const std::string& last_rejection() const { return last_rejection_; }
  std::size_t rejected_count() const { return rejected_; }

 private:
  /// Why a command cannot be followed; nothing if it can.
  std::optional<std::string> complaint(const std::vector<std::string>& names,
                                       const std::vector<double>& efforts) const;
  bool knows(const std::string& name) const;

  std::vector<int> joints_;  ///< of the skeleton
  ecu::Supervisor supervisor_;
  std::size_t rejected_ = 0;
  std::string last_rejection_;
};

}  // namespace anthrob
