#pragma once

#include <cstdint>

namespace anthrob {
namespace ecu {

/// States of the fail-silent unit; numbers as on the wire and in MuscleStates.
enum class State : std::uint8_t { kBoot = 0, kIdle = 1, kEnabled = 2, kStopping = 3, kFault = 4 };
constexpr int kStateCount = 5;

enum class Event : std::uint8_t {
  kSelfTestPassed,
  kEnable,
  kDisable,
  kEmergencyStop,   ///< wins over everything; holds until cleared
  kCommandTimeout,  ///< no fresh command in time
  kFaultDetected,
  kClear,  ///< clears a stop or a fault
};

/// The ECU follows references in State::kEnabled only; everywhere else its output is zero volts.
class StateMachine {
 public:
  State state() const { return state_; }
  bool follows_references() const { return state_ == State::kEnabled; }
  /// An emergency stop was pressed and not cleared: enable is refused.
  bool stop_latched() const { return stop_latched_; }

  /// @return whether the event was accepted; a refused event changes nothing
  bool handle(Event event);

 private:
  State state_ = State::kBoot;
  bool stop_latched_ = false;
};

const char* name(State state);

}  // namespace ecu
}  // namespace anthrob
