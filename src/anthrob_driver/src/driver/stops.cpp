// What stops the motors without a user, and the routines of several cycles.
#include <algorithm>
#include <cmath>

#include "driver/implementation.h"

namespace anthrob {
namespace driver {

void RobotDriver::Implementation::stop(Finding finding, int ecu, const std::string& detail) {
  if (phase_ == Phase::kDisabled) return;
  const std::string what = stopping_.reason(finding, ecu, detail);
  halt(finding, ecu, what);
  stopping_.record(finding, what);
}

void RobotDriver::Implementation::stop_for_unit(Finding finding, int ecu, double now) {
  if (phase_ == Phase::kDisabled) return;
  name_stop(HUGE_VAL);  // record an earlier stop that still waits for its reason
  const std::string what = stopping_.reason(finding, ecu, stopping_.fault_of(ecu));
  halt(finding, ecu, what);
  stopping_.expect_reason(finding, ecu, what, now);
}

void RobotDriver::Implementation::halt(Finding finding, int ecu, const std::string& what) {
  home_.abort(what);
  if (phase_ == Phase::kEnabling) finish_enable(false, what);
  disable();
  // The unit that failed must be cleared by the user; the others are only disabled.
  if (ecu >= 0 && finding != Finding::kEcuStopped)
    supervisor_.fault(links_[static_cast<std::size_t>(ecu)].own().name);
  last_outcome_ = {false, what};
}

void RobotDriver::Implementation::name_stop(double now) {
  const std::optional<Stopping::Explained> stop = stopping_.take_reason(now);
  if (!stop) return;
  findings_.add(stop->finding, stop->ecu, last_cycle_, stop->fault);
  if (last_outcome_.reason == stop->told) last_outcome_ = {false, stop->what};
  stopping_.record(stop->finding, stop->what, stop->remedy);
}

void RobotDriver::Implementation::obey_stop(int ecu) {
  const bool own = ecu >= 0 && links_[static_cast<std::size_t>(ecu)].holds_own_stop();
  const std::string what =
      ecu < 0 ? "a STOP frame came from elsewhere on the bus"
      : own   ? stopping_.prefix(ecu) + "still holds an emergency stop of this driver"
              : stopping_.prefix(ecu) + info(Finding::kStopLatched).meaning;
  home_.abort(what);
  emergency_stop();
  last_outcome_ = {false, what};
  stopping_.record(Finding::kStopLatched, what, own ? "clear_faults, enable" : nullptr);
}

void RobotDriver::Implementation::fail_home(double now) {
  findings_.add(Finding::kHomeFailed, -1, now, home_.failure());
  for (std::size_t m = 0; m < hardware_.muscles.size(); ++m) {
    if (home_.tendon_lost(m)) revoke_zero(hardware_.muscles[m]);
  }
  disable();
  last_outcome_ = {false, home_.failure()};
  stopping_.record(Finding::kHomeFailed, home_.failure());
}

void RobotDriver::Implementation::revoke_zero(const MuscleHardware& muscle) {
  links_[static_cast<std::size_t>(muscle.ecu)].revoke_zero(muscle.channel);
}

void RobotDriver::Implementation::check_bus(double now) {
  const double period = 1.0 / options_.rate;
  const double late = cycles_ > 0 ? now - last_cycle_ - period : 0.0;
  const bool too_late = late > period;
  if (too_late) findings_.add(Finding::kLateCycle, -1, now);
  watch_.cycle(now, too_late ? late : 0.0);
  Finding finding;
  if (watch_.take_stop(finding)) stop(finding, -1);
}

/// Of a bus on which nobody answers, no single ECU is to blame. The first ECUs may have answered
/// the SYNC during which it fell silent, so that they have missed one less.
bool RobotDriver::Implementation::bus_silent() const {
  const auto answered_once = [](const EcuLink& link) { return link.sample_time() > 0.0; };
  const auto missed = [](const EcuLink& link) { return !link.answered_last(); };
  const auto lost = [](const EcuLink& link) { return !link.alive(); };
  return links_.size() > 1 && std::all_of(links_.begin(), links_.end(), answered_once) &&
         std::all_of(links_.begin(), links_.end(), missed) &&
         std::any_of(links_.begin(), links_.end(), lost);
}

void RobotDriver::Implementation::check_ecus(double now) {
  const bool silent = bus_silent();
  if (silent) {
    findings_.add(Finding::kBusSilent, -1, now);
    stop(Finding::kBusSilent, -1);
  }
  for (std::size_t e = 0; e < links_.size(); ++e) {
    EcuLink& link = links_[e];
    const int index = static_cast<int>(e);
    if (link.take_restart()) {
      gains_.abort(index, link.own().name + " restarted", now);
      stop(Finding::kEcuRestarted, index);
      // While nothing runs too: its zero is lost, and the user must know before enabling.
      supervisor_.fault(link.own().name);
    }
    if (link.take_wrong_version()) stop(Finding::kWrongVersion, index);
    if (!link.heard()) {
      if (link.other_version().empty() && now - started_ > kSilence)
        findings_.add(Finding::kEcuSilent, index, now);
      continue;
    }
    if (!link.alive() && (link.sample_time() > 0.0 || now - link.heard_since() > kSilence)) {
      if (silent) continue;
      findings_.add(Finding::kEcuLost, index, now);
      stop(Finding::kEcuLost, index);
      continue;
    }
    // Do not report again a fault that is being cleared.
    if (link.state() == ecu::State::kFault && !(phase_ == Phase::kDisabled && clearing(now))) {
      findings_.add(Finding::kEcuFault, index, now, stopping_.fault_of(index));
      stop_for_unit(Finding::kEcuFault, index, now);
    }
    if (link.stop_latched() && !supervisor_.stop_latched() && now - cleared_ > kClearGrace) {
      findings_.add(Finding::kStopLatched, index, now);
      obey_stop(index);
    }
    if (phase_ == Phase::kEnabled && link.state() != ecu::State::kEnabled) {
      stop_for_unit(Finding::kEcuStopped, index, now);
    }
    // A late enable from a queue, or from somebody else: nothing may be enabled now.
    if (phase_ == Phase::kDisabled && link.state() == ecu::State::kEnabled) disable_repeats_ = 1;
  }
  name_stop(now);
}

void RobotDriver::Implementation::check_muscles(double now) {
  for (std::size_t m = 0; m < hardware_.muscles.size(); ++m) {
    const auto alarm = muscles_[m].step(sampler_.last().muscles[m], sampler_.last().time,
                                        phase_ == Phase::kEnabled, home_.running());
    if (!alarm) continue;
    const MuscleHardware& wired = hardware_.muscles[m];
    findings_.add(alarm->finding, wired.ecu, now, alarm->detail);
    if (alarm->zero_lost) revoke_zero(wired);
    stop(alarm->finding, wired.ecu, alarm->detail);
  }
}

void RobotDriver::Implementation::continue_home(double now) {
  if (!home_.running()) return;
  std::vector<Home::Reading> readings;
  for (const MuscleSample& muscle : sampler_.last().muscles) {
    readings.push_back({muscle.position, muscle.force});
  }
  if (home_.state() == Home::State::kReached) return continue_zero(readings, now);
  home_.step(readings, now);
  for (std::size_t m = 0; m < hardware_.muscles.size(); ++m) {
    references_[m] = home_.command(m, now);
  }
  if (home_.state() == Home::State::kFailed) return fail_home(now);
  if (home_.state() == Home::State::kReached) zeros_.start();
}

void RobotDriver::Implementation::continue_zero(const std::vector<Home::Reading>& readings,
                                                double now) {
  // The tendons are held meanwhile. A zero counts once its ECU has confirmed it.
  home_.hold(readings);
  if (home_.state() == Home::State::kFailed) return fail_home(now);
  switch (zeros_.step(now, [this](const ecu::Frame& frame) { send(frame); })) {
    case Zeros::State::kWaiting:
      return;
    case Zeros::State::kRefused:
      home_.abort(zeros_.refusal());
      return fail_home(now);
    case Zeros::State::kTaken:
      return home_.finish();
  }
}

}  // namespace driver
}  // namespace anthrob
