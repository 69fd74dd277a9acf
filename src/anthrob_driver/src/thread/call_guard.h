#pragma once

#include <cstdint>

#include "anthrob_driver/robot_driver.h"

namespace anthrob {
namespace driver {

/// Guards a service call that waits for its turn and then for the robot. Anything that stops the
/// motors after the call arrived takes precedence over it.
class CallGuard {
 public:
  /// @param received RobotDriver::halts() when the call came in
  explicit CallGuard(std::uint64_t received) : received_(received) {}

  /// To be called when the call is about to be carried out.
  /// @return false if the motors were stopped since the call arrived; `outcome` then says so
  bool may_begin(const RobotDriver& driver, RobotDriver::Outcome& outcome) const {
    if (driver.halts() == received_) return true;
    outcome = {false, "the motors were stopped after this was called; call it again"};
    return false;
  }
  /// To be called last: turns a success into a failure if a stop undid it before the answer.
  void confirm(const RobotDriver& driver, RobotDriver::Outcome& outcome) const {
    if (!outcome.accepted || driver.halts() == received_) return;
    outcome = {false, "it succeeded, and then the motors were stopped"};
  }

 private:
  std::uint64_t received_;
};

}  // namespace driver
}  // namespace anthrob
