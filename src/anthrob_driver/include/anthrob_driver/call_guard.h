#pragma once

#include <cstdint>

#include "anthrob_driver/robot_driver.h"

namespace anthrob {
namespace driver {

/// A call of a user that waits for its turn, and then for the robot. Whatever stops the motors from
/// the moment it came in wins over it.
class CallGuard {
 public:
  /// @param received RobotDriver::halts() when the call came in
  explicit CallGuard(std::uint64_t received) : received_(received) {}

  /// Its turn has come. @return false if the motors were stopped meanwhile; `outcome` says so
  bool may_begin(const RobotDriver& driver, RobotDriver::Outcome& outcome) const {
    if (driver.halts() == received_) return true;
    outcome = {false, "the motors were stopped after this was called; call it again"};
    return false;
  }
  /// Last of all: a success that was undone before it is told is none.
  void confirm(const RobotDriver& driver, RobotDriver::Outcome& outcome) const {
    if (!outcome.accepted || driver.halts() == received_) return;
    outcome = {false, "it succeeded, and then the motors were stopped"};
  }

 private:
  std::uint64_t received_;
};

}  // namespace driver
}  // namespace anthrob
