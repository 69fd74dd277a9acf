#include "anthrob_driver/zeros.h"

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

void Zeros::start(double now) {
  deadline_ = now + kTimeout;
  for (EcuLink& link : links_) link.start_zero();
  update();
}

Zeros::State Zeros::step(double now, const Send& send) {
  bool all = true;
  for (EcuLink& link : links_) {
    if (link.zeroed()) continue;
    all = false;
    if (link.zero_refused() || now > deadline_) {
      refusal_ = link.zeroing().name + ": " + link.own().name + " does not take the zero";
      return State::kRefused;
    }
    ecu::Frame frame;
    if (link.next_zero(now, frame)) send(frame);
  }
  return all ? State::kTaken : State::kWaiting;
}

}  // namespace driver
}  // namespace anthrob
