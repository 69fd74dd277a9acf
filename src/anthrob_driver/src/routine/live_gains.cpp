#include "routine/live_gains.h"

#include <algorithm>

namespace anthrob {
namespace driver {

const MuscleHardware& LiveGains::muscle_of(const ecu::GainChange& change) const {
  return hardware_.muscles[static_cast<std::size_t>(change.gain.muscle)];
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

void LiveGains::step(double now, bool disabled, const Send& send) {
  if (!changing_) return;
  ++cycles_;
  if (at_ == changes_.size()) {
    const auto differs = [&](const ecu::GainChange& change) {
      return link_of(change).alive() && !link_of(change).configured();
    };
    const auto change = std::find_if(changes_.begin(), changes_.end(), differs);
    if (!disabled || change == changes_.end()) return finish(std::nullopt, now);
    if (now > deadline_)
      finish(link_of(*change).own().name + " does not report the gains that it was given", now);
    return;
  }
  const EcuLink::Write write = link().write();
  if (write == EcuLink::Write::kTaken) {
    take(now);
    ++at_;
    return begin_next(now);
  }
  if (write == EcuLink::Write::kRefused || now > deadline_) {
    return finish(muscle().name + ": " + link().own().name + " does not confirm " +
                      ecu::name(changes_[at_].gain.parameter) +
                      ", so it may hold the new or the previous value: try again, or disable the "
                      "motors, and the driver restores the previous one",
                  now);
  }
  if (cycles_ % EcuLink::kCyclesPerWrite != 0) return;
  ecu::Frame frame;
  if (link().next_write(now, frame)) send(frame);
}

void LiveGains::abort(int ecu, const std::string& reason, double now) {
  const bool concerned =
      std::any_of(changes_.begin(), changes_.end(),
                  [&](const ecu::GainChange& change) { return muscle_of(change).ecu == ecu; });
  if (changing_ && concerned) finish(reason, now);
}

void LiveGains::take(double now) {
  hardware_.muscles[static_cast<std::size_t>(changes_[at_].gain.muscle)].parameters.set(
      changes_[at_].gain.parameter, changes_[at_].value);
  update_configuration(hardware_, muscle().ecu);
  link().expect_configuration(now);
}

void LiveGains::finish(const std::optional<std::string>& refusal, double now) {
  changing_ = false;
  ++ended_;
  outcome_ = {!refusal, refusal.value_or("")};
  for (const ecu::GainChange& change : changes_) {
    link_of(change).end_write();
    // Whatever it holds now: it is compared, and mended, as any configuration.
    if (refusal) link_of(change).expect_configuration(now);
  }
}

}  // namespace driver
}  // namespace anthrob
