#include "anthrob_driver/live_gains.h"

#include <algorithm>

namespace anthrob {
namespace driver {

const MuscleHardware& LiveGains::muscle() const {
  return hardware_.muscles[static_cast<std::size_t>(changes_[at_].gain.muscle)];
}

void LiveGains::start(std::vector<ecu::GainChange> changes, double now) {
  changes_ = std::move(changes);
  at_ = 0;
  changing_ = true;
  begin_next(now);
}

void LiveGains::begin_next(double now) {
  deadline_ = now + kTimeout;
  if (at_ == changes_.size()) return;
  link().start_write(muscle().channel, changes_[at_].gain.parameter,
                     static_cast<float>(changes_[at_].value));
}

void LiveGains::step(double now, const Send& send) {
  if (!changing_) return;
  ++cycles_;
  if (at_ == changes_.size()) {
    // The next enable wants the units' word for all of their parameters.
    const auto differs = [](const EcuLink& link) { return link.alive() && !link.configured(); };
    const auto silent = std::find_if(links_.begin(), links_.end(), differs);
    if (silent == links_.end()) return finish("", now);
    if (now > deadline_) finish(silent->own().name + " does not report what it was given", now);
    return;
  }
  const EcuLink::Write write = link().write();
  if (write == EcuLink::Write::kTaken) {
    take(now);
    ++at_;
    return begin_next(now);
  }
  if (write == EcuLink::Write::kRefused || now > deadline_) {
    return finish(muscle().name + ": " + link().own().name + " does not take " +
                      ecu::name(changes_[at_].gain.parameter) +
                      "; it is written anew when the motors are disabled",
                  now);
  }
  if (cycles_ % kCyclesPerWrite != 0) return;
  ecu::Frame frame;
  if (link().next_write(now, frame)) send(frame);
}

void LiveGains::take(double now) {
  hardware_.muscles[static_cast<std::size_t>(changes_[at_].gain.muscle)].parameters.set(
      changes_[at_].gain.parameter, changes_[at_].value);
  update_configuration(hardware_, muscle().ecu);
  link().expect_configuration(now);
}

void LiveGains::finish(const std::string& refusal, double now) {
  changing_ = false;
  outcome_ = {refusal.empty(), refusal};
  // Whatever it holds now: it is compared, and mended, as any configuration.
  for (EcuLink& each : links_) {
    each.end_write();
    if (!refusal.empty()) each.expect_configuration(now);
  }
}

}  // namespace driver
}  // namespace anthrob
