#include "watch/bus_watch.h"

#include <algorithm>
#include <utility>

namespace anthrob {
namespace driver {

void BusWatch::found(Finding finding, double now) {
  findings_.add(finding, std::nullopt, now);
  if (!info(finding).stops) return;
  stop_ = finding;
}

void BusWatch::receive(const BusEvent& event, double now) {
  using Kind = BusEvent::Kind;
  switch (event.kind) {
    case Kind::kFrame:
      ++frames_;
      ++frames_this_cycle_;
      // Who hears others is no longer off the bus.
      if (condition_ == Condition::kOff) condition_ = Condition::kGood;
      break;
    case Kind::kEcho:
      if (condition_ == Condition::kOff) condition_ = Condition::kGood;
      echoes_ = true;
      unheard_ = false;
      last_echo_ = now;
      break;
    case Kind::kForeign:
      ++frames_this_cycle_;
      found(Finding::kForeignFrame, now);
      break;
    case Kind::kErrorActive:
      condition_ = Condition::kGood;
      break;
    case Kind::kErrorWarning:
      // On the way back from passive, too.
      if (condition_ == Condition::kPassive) condition_ = Condition::kGood;
      found(Finding::kErrorWarning, now);
      break;
    case Kind::kBusError:
      found(Finding::kErrorWarning, now);
      break;
    case Kind::kErrorPassive:
      condition_ = Condition::kPassive;
      found(Finding::kErrorPassive, now);
      break;
    case Kind::kBusOff:
      condition_ = Condition::kOff;
      found(Finding::kBusOff, now);
      break;
    case Kind::kNoAcknowledge:
      unheard_ = true;
      found(Finding::kNoAcknowledge, now);
      break;
    case Kind::kReceiveOverrun:
      found(Finding::kReceiveOverrun, now);
      break;
    case Kind::kDown:
      condition_ = Condition::kDown;
      found(Finding::kInterfaceDown, now);
      break;
    case Kind::kUp:
      condition_ = Condition::kGood;
      last_echo_ = now;
      break;
  }
}

void BusWatch::sent(SendResult result, double now) {
  if (result == SendResult::kQueueFull) queue_full_ = true;
  if (result == SendResult::kDown && condition_ != Condition::kDown) {
    condition_ = Condition::kDown;
    found(Finding::kInterfaceDown, now);
  }
}

void BusWatch::cycle(double now, double late) {
  last_echo_ = std::min(last_echo_ + late, now);
  full_cycles_ = queue_full_ ? full_cycles_ + 1 : 0;
  queue_full_ = false;
  if (full_cycles_ >= kFullCycles) found(Finding::kQueueFull, now);
  if (frames_this_cycle_ > kFlood) found(Finding::kBusFlooded, now);
  frames_this_cycle_ = 0;
  if (condition_ == Condition::kDown) {
    last_echo_ = now;
  } else if (echoes_ && now - last_echo_ > kEchoTimeout + 2.0 / rate_) {
    unheard_ = true;
    found(Finding::kNoAcknowledge, now);
  }
}

std::optional<std::string> BusWatch::trouble() const {
  switch (condition_) {
    case Condition::kDown:
      return "the CAN interface is down or missing";
    case Condition::kOff:
      return "the CAN controller is bus-off; check cable, termination and bit rate";
    case Condition::kPassive:
      // Only it knows when that is over; single errors are not reported to us.
      return "the CAN controller is error-passive and has not reported that it recovered; if the "
             "bus is in order, set the interface down and up";
    default:
      break;
  }
  if (unheard_)
    return "no node on the bus acknowledges the driver's frames; are the ECUs switched on?";
  if (full_cycles_ >= kFullCycles)
    return "the CAN interface accepts no more frames; are the ECUs switched on?";
  return std::nullopt;
}

std::optional<Finding> BusWatch::take_stop() {
  return std::exchange(stop_, std::nullopt);
}

}  // namespace driver
}  // namespace anthrob
