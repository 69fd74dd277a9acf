#include "routine/zeros.h"

#include <algorithm>

namespace anthrob {
namespace driver {

Zeros::Zeros(std::vector<EcuLink>& links, ecu::Supervisor& supervisor)
    : links_(links), supervisor_(supervisor) {
  update();
}

void Zeros::update() {
  for (const EcuLink& link : links_) {
    if (link.zero_known()) {
      supervisor_.regain_zero(link.own().name);
    } else {
      supervisor_.lose_zero(link.own().name);
    }
  }
}

void Zeros::start() {
  asked_ = nullptr;
  for (EcuLink& link : links_) link.start_zero();
  update();
}

Zeros::State Zeros::step(double now, const Send& send) {
  const auto link =
      std::find_if(links_.begin(), links_.end(), [](const EcuLink& one) { return !one.zeroed(); });
  if (link == links_.end()) return State::kTaken;
  if (const MuscleHardware* next = &link->zeroing(); next != asked_) {
    asked_ = next;
    deadline_ = now + kTimeout;
  }
  if (link->zero_refused() || now > deadline_) {
    refusal_ = asked_->name + ": " + link->own().name + " does not confirm the new zero";
    return State::kRefused;
  }
  ecu::Frame frame;
  if (++cycles_ % EcuLink::kCyclesPerWrite == 0 && link->next_zero(now, frame)) send(frame);
  return State::kWaiting;
}

}  // namespace driver
}  // namespace anthrob
