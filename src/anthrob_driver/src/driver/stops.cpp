// What stops the motors without a user, and the routines of several cycles.
#include <algorithm>
#include <cmath>

#include "driver/implementation.h"

namespace anthrob {
namespace driver {

static_assert(RobotDriver::kSilence == kFirstAnswer, "one time to be heard");

void RobotDriver::Implementation::stop(const StoppingRule& rule, std::optional<int> ecu, double now,
                                       const std::string& detail) {
  if (rule.noted == Noted::kByRule) findings_.add(rule.finding, ecu, now, detail);
  const bool was_on = phase_ != Phase::kDisabled;
  switch (rule.reaction) {
    case Reaction::kDisable: {
      if (!was_on) break;
      const std::string what = stopping_.reason(rule.finding, ecu, detail);
      disable_for(rule, ecu, what);
      stopping_.record(rule.finding, what);
      break;
    }
    case Reaction::kDisableThenExplain: {
      if (!was_on) break;
      explain_stop(HUGE_VAL);  // an earlier stop that still waits for its reason
      const std::string what = stopping_.reason(rule.finding, *ecu, detail);
      disable_for(rule, ecu, what);
      stopping_.expect_reason(rule.finding, *ecu, what, now);
      break;
    }
    case Reaction::kEmergencyStop:
      if (rule.noticed_by == NoticedBy::kNode) {
        latch_stop(rule.finding, stopping_.reason(rule.finding, ecu, detail));
      } else {
        obey_emergency_stop(ecu);
      }
      break;
    case Reaction::kEndHome:
      end_home();
      break;
  }
  if (rule.concerned == Concerned::kAlwaysFault) {
    supervisor_.fault(links_[static_cast<std::size_t>(*ecu)].own().name);
  }
}

void RobotDriver::Implementation::disable_for(const StoppingRule& rule, std::optional<int> ecu,
                                              const std::string& what) {
  home_.abort(what);
  if (phase_ == Phase::kEnabling) finish_enable(false, what);
  disable();
  if (rule.concerned == Concerned::kFault) {
    supervisor_.fault(links_[static_cast<std::size_t>(*ecu)].own().name);
  }
  last_outcome_ = {false, what};
}

void RobotDriver::Implementation::explain_stop(double now) {
  const std::optional<Stopping::Explained> stop = stopping_.take_reason(now);
  if (!stop) return;
  findings_.add(stop->finding, stop->ecu, last_cycle_, stop->fault.value_or(""));
  if (last_outcome_.reason == stop->told) last_outcome_ = {false, stop->what};
  stopping_.record(stop->finding, stop->what, stop->remedy);
}

void RobotDriver::Implementation::obey_emergency_stop(std::optional<int> ecu) {
  const bool own = ecu && links_[static_cast<std::size_t>(*ecu)].holds_own_stop();
  const std::string what =
      !ecu  ? "a STOP frame came from elsewhere on the bus"
      : own ? stopping_.prefix(*ecu) + "still holds an emergency stop of this driver"
            : stopping_.prefix(*ecu) + info(Finding::kStopLatched).meaning;
  latch_stop(Finding::kStopLatched, what, own ? "clear_faults, enable" : nullptr);
}

void RobotDriver::Implementation::latch_stop(Finding finding, const std::string& what,
                                             const char* remedy) {
  home_.abort(what);
  emergency_stop();
  last_outcome_ = {false, what};
  stopping_.record(finding, what, remedy);
}

void RobotDriver::Implementation::end_home() {
  for (std::size_t m = 0; m < hardware_.muscles.size(); ++m) {
    if (home_.tendon_lost(m)) revoke_zero(hardware_.muscles[m]);
  }
  disable();
  last_outcome_ = {false, *home_.failure()};
  stopping_.record(Finding::kHomeFailed, *home_.failure());
}

void RobotDriver::Implementation::revoke_zero(const MuscleHardware& muscle) {
  links_[static_cast<std::size_t>(muscle.ecu)].revoke_zero(muscle.channel);
}

void RobotDriver::Implementation::check_bus(double now) {
  const double period = 1.0 / options_.rate;
  const double late = cycles_ > 0 ? now - last_cycle_ - period : 0.0;
  const bool too_late = late > period;
  if (too_late) findings_.add(Finding::kLateCycle, std::nullopt, now);
  watch_.cycle(now, too_late ? late : 0.0);
  if (const auto finding = watch_.take_stop()) {
    stop(stopping_rule(*finding, NoticedBy::kBusWatch), std::nullopt, now);
  }
}

Situation RobotDriver::Implementation::situation(bool silent, double now) const {
  Situation result;
  result.enabled = phase_ == Phase::kEnabled;
  result.disabled = phase_ == Phase::kDisabled;
  result.stop_latched = supervisor_.stop_latched();
  result.clearing = clearing(now);
  result.bus_silent = silent;
  result.now = now;
  result.since_clear = cleared_ ? now - *cleared_ : HUGE_VAL;
  return result;
}

void RobotDriver::Implementation::check_ecus(double now) {
  const bool silent = bus_silent(links_);
  if (silent) stop(stopping_rule(Finding::kBusSilent, NoticedBy::kAllEcus), std::nullopt, now);
  for (std::size_t e = 0; e < links_.size(); ++e) check_ecu(static_cast<int>(e), silent, now);
  explain_stop(now);
}

void RobotDriver::Implementation::check_ecu(int ecu, bool silent, double now) {
  EcuLink& link = links_[static_cast<std::size_t>(ecu)];
  for (const StoppingRule& rule : kStoppingRules) {
    // Each rule sees what those before it have done.
    if (rule.noticed_by != NoticedBy::kEcu || !rule.holds(link, situation(silent, now))) continue;
    if (rule.finding == Finding::kEcuRestarted) {
      gains_.abort(ecu, link.own().name + " restarted", now);
    }
    const bool explains = rule.reaction == Reaction::kDisableThenExplain;
    stop(rule, ecu, now, explains ? stopping_.fault_of(ecu).value_or("") : "");
  }
  if (!link.heard()) {
    if (!link.other_version() && now - started_ > kSilence) {
      findings_.add(Finding::kEcuSilent, ecu, now);
    }
    return;
  }
  // A late enable from a queue, or from somebody else: nothing may be enabled now.
  const bool enabled = !is_lost(link, now) && link.state() == ecu::State::kEnabled;
  if (phase_ == Phase::kDisabled && enabled) disable_repeats_ = 1;
}

void RobotDriver::Implementation::check_muscles(double now) {
  for (std::size_t m = 0; m < hardware_.muscles.size(); ++m) {
    const auto alarm = muscles_[m].step(sampler_.last().muscles[m], sampler_.last().time,
                                        phase_ == Phase::kEnabled, home_.running());
    if (!alarm) continue;
    const MuscleHardware& wired = hardware_.muscles[m];
    if (alarm->zero_lost) revoke_zero(wired);
    stop(stopping_rule(alarm->finding, NoticedBy::kMuscleWatch), wired.ecu, now, alarm->detail);
  }
}

void RobotDriver::Implementation::continue_home(double now) {
  if (!home_.running()) return;
  const StoppingRule& home_failed = stopping_rule(Finding::kHomeFailed, NoticedBy::kHome);
  std::vector<Home::Reading> readings;
  for (const MuscleSample& muscle : sampler_.last().muscles) {
    readings.push_back({muscle.position, muscle.force});
  }
  if (home_.state() == Home::State::kReached) return continue_zero(readings, now);
  home_.step(readings, now);
  for (std::size_t m = 0; m < hardware_.muscles.size(); ++m) {
    references_[m] = home_.command(m, now);
  }
  if (home_.state() == Home::State::kFailed)
    return stop(home_failed, std::nullopt, now, *home_.failure());
  if (home_.state() == Home::State::kReached) zeros_.start();
}

void RobotDriver::Implementation::continue_zero(const std::vector<Home::Reading>& readings,
                                                double now) {
  const StoppingRule& home_failed = stopping_rule(Finding::kHomeFailed, NoticedBy::kHome);
  // The tendons are held meanwhile. A zero counts once its ECU has confirmed it.
  home_.hold(readings);
  if (home_.state() == Home::State::kFailed)
    return stop(home_failed, std::nullopt, now, *home_.failure());
  switch (zeros_.step(now, [this](const ecu::Frame& frame) { send(frame); })) {
    case Zeros::State::kWaiting:
      return;
    case Zeros::State::kRefused:
      home_.abort(zeros_.refusal());
      return stop(home_failed, std::nullopt, now, *home_.failure());
    case Zeros::State::kTaken:
      return home_.finish();
  }
}

}  // namespace driver
}  // namespace anthrob
