#include "anthrob_driver/zeros.h"

namespace anthrob {
namespace driver {

void Zeros::lose(std::size_t ecu) {
  lost_[ecu] = true;
  supervisor_.lose_zero(links_[ecu].own().name);
}

void Zeros::start(double now) {
  deadline_ = now + kTimeout;
  for (std::size_t e = 0; e < links_.size(); ++e) {
    // Muscles that were not pulled keep their zero, unless it is lost anyway.
    links_[e].start_zero(lost_[e]);
    // From here on it is the old one or the new one, until it is confirmed.
    if (!links_[e].zeroed()) supervisor_.lose_zero(links_[e].own().name);
  }
}

Zeros::State Zeros::step(double now, const Send& send) {
  bool all = true;
  for (std::size_t e = 0; e < links_.size(); ++e) {
    EcuLink& link = links_[e];
    if (link.zeroed()) {
      supervisor_.regain_zero(link.own().name);
      lost_[e] = false;
      continue;
    }
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
