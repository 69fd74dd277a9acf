#include "anthrob_ecu/state_machine.h"

#include <cstddef>

namespace anthrob {
namespace ecu {

namespace {

struct Transition {
  State from;
  Event event;
  bool needs_released_stop;  ///< guard: this row does not count while an emergency stop is latched
  State to;
};

// The first row that fits counts; everything that is not listed is refused.
constexpr Transition kTransitions[] = {
    {State::kBoot, Event::kSelfTestPassed, true, State::kIdle},
    {State::kBoot, Event::kSelfTestPassed, false, State::kStopping},
    {State::kIdle, Event::kEnable, true, State::kEnabled},
    {State::kEnabled, Event::kEnable, true, State::kEnabled},
    {State::kStopping, Event::kEnable, true, State::kEnabled},
    {State::kIdle, Event::kDisable, false, State::kIdle},
    {State::kEnabled, Event::kDisable, false, State::kStopping},
    {State::kStopping, Event::kDisable, false, State::kStopping},
    {State::kEnabled, Event::kCommandTimeout, false, State::kStopping},
    {State::kBoot, Event::kEmergencyStop, false, State::kBoot},  // the self test is still to come
    {State::kIdle, Event::kEmergencyStop, false, State::kStopping},
    {State::kEnabled, Event::kEmergencyStop, false, State::kStopping},
    {State::kStopping, Event::kEmergencyStop, false, State::kStopping},
    {State::kFault, Event::kEmergencyStop, false, State::kFault},
    {State::kBoot, Event::kFaultDetected, false, State::kFault},
    {State::kIdle, Event::kFaultDetected, false, State::kFault},
    {State::kEnabled, Event::kFaultDetected, false, State::kFault},
    {State::kStopping, Event::kFaultDetected, false, State::kFault},
    {State::kFault, Event::kFaultDetected, false, State::kFault},
    {State::kIdle, Event::kClear, false, State::kIdle},
    {State::kStopping, Event::kClear, false, State::kIdle},
    {State::kFault, Event::kClear, false, State::kIdle},
};

}  // namespace

bool StateMachine::handle(Event event) {
  for (const Transition& t : kTransitions) {
    if (t.from != state_ || t.event != event) continue;
    if (t.needs_released_stop && stop_latched_) continue;
    state_ = t.to;
    if (event == Event::kEmergencyStop) stop_latched_ = true;
    if (event == Event::kClear) stop_latched_ = false;
    return true;
  }
  return false;
}

const char* name(State state) {
  constexpr const char* kNames[kStateCount] = {"BOOT", "IDLE", "ENABLED", "STOPPING", "FAULT"};
  const auto index = static_cast<std::size_t>(state);
  return index < kStateCount ? kNames[index] : "UNKNOWN";
}

}  // namespace ecu
}  // namespace anthrob
