// What users ask for.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "driver/implementation.h"

namespace anthrob {
namespace driver {

namespace {

using ecu::Operation;

constexpr int kRepeats = 3;  // cycles in which disable and clear are sent

std::optional<std::string> too_old(double age, double limit) {
  if (std::abs(age) <= limit) return std::nullopt;
  char text[120];
  std::snprintf(text, sizeof(text),
                "sent %.1f s %s: a recording, or the clocks of two computers differ", std::abs(age),
                age > 0.0 ? "ago" : "ahead of time");
  return text;
}

}  // namespace

RobotDriver::Outcome RobotDriver::Implementation::command(const std::vector<std::string>& names,
                                                          const std::vector<std::uint8_t>& modes,
                                                          const std::vector<double>& references,
                                                          double now, double age,
                                                          const std::string& sender) {
  if (const auto old = too_old(age, options_.command_timeout)) return refuse(*old);
  if (home_.running()) return refuse("home is running");
  if (phase_ == Phase::kEnabled) {
    const auto far = first_step_.too_far(names, modes, references, references_, sampler_.last());
    if (far) return refuse(*far);
  }
  // The time-out runs from when it was sent. A stamp in the future gains nothing.
  const Outcome outcome =
      supervisor_.command(names, modes, references, now - std::max(0.0, age), accepted_, sender);
  if (!outcome.accepted) return outcome;
  for (const ecu::MuscleReference& reference : accepted_) {
    references_[static_cast<std::size_t>(reference.muscle)] = reference;
  }
  return outcome;
}

std::optional<std::string> RobotDriver::Implementation::why_not_enable() const {
  if (supervisor_.stop_latched()) return "emergency stop is latched: call clear_faults first";
  if (const auto trouble = watch_.trouble()) return trouble;
  if (gains_.changing()) return "gains are being changed; try again in a second";
  for (const EcuLink& link : links_) {
    const std::string who = link.own().name + ": ";
    if (supervisor_.state(link.own().muscles.front()) == ecu::State::kFault) {
      return who + "is in FAULT: call clear_faults first";
    }
    if (const auto reason = link.why_not_enable()) return who + *reason;
  }
  for (const MuscleWatch& muscle : muscles_) {
    if (const auto reason = muscle.why_not_enable()) return reason;
  }
  return std::nullopt;
}

RobotDriver::Outcome RobotDriver::Implementation::start_enable(double now) {
  if (phase_ == Phase::kEnabled) return last_outcome_ = {true, "already enabled"};
  if (phase_ == Phase::kEnabling) return {true, "enabling"};
  explain_stop(HUGE_VAL);
  if (const auto reason = why_not_enable()) {
    findings_.add(Finding::kEnableRefused, std::nullopt, now, *reason);
    return last_outcome_ = {false, *reason};
  }
  phase_ = Phase::kEnabling;
  // Outcome reported if disable() comes before confirmation.
  last_outcome_ = {false, "disabled before every ECU confirmed"};
  disable_repeats_ = clear_repeats_ = 0;
  enabling_.start(links_.size(), now);
  for (ecu::MuscleReference& reference : references_) {
    reference.mode = ecu::Mode::kVoltage;
    reference.reference = 0.0;
  }
  return {true, "enabling"};
}

void RobotDriver::Implementation::continue_enable(double now) {
  const auto ask = [this](const EcuLink& link) {
    return request(Operation::kEnable, link.own().node, link.own().configuration,
                   link.report().session);
  };
  switch (enabling_.step(links_, now, ask)) {
    case Enabling::State::kWaiting:
      return;
    case Enabling::State::kRefused:
      return finish_enable(false, enabling_.refusal());
    case Enabling::State::kConfirmed: {
      const Outcome outcome = supervisor_.enable(now);
      return finish_enable(outcome.accepted, outcome.reason);
    }
  }
}

void RobotDriver::Implementation::finish_enable(bool success, const std::string& reason) {
  last_outcome_ = {success, reason};
  if (success) {
    phase_ = Phase::kEnabled;
    return;
  }
  findings_.add(Finding::kEnableRefused, std::nullopt, last_cycle_, reason);
  disable();
}

RobotDriver::Outcome RobotDriver::Implementation::start_home(double now) {
  if (phase_ != Phase::kEnabled) return {false, "not enabled: call enable first"};
  if (home_.running()) return {false, "home is running already"};
  if (gains_.changing()) return {false, "gains are being changed; try again in a second"};
  home_.start(now);
  return {true, "homing"};
}

RobotDriver::Outcome RobotDriver::Implementation::clear_faults(double now) {
  const Outcome outcome = supervisor_.clear_faults();
  if (phase_ != Phase::kDisabled) return outcome;
  explain_stop(HUGE_VAL);
  findings_.clear();
  cleared_ = now;
  disable_repeats_ = 0;
  clear_repeats_ = kRepeats;
  return outcome;
}

RobotDriver::Outcome RobotDriver::Implementation::start_gains(const std::vector<std::string>& names,
                                                              const std::vector<std::string>& gains,
                                                              const std::vector<double>& values,
                                                              double now) {
  std::vector<ecu::GainChange> changes;
  const auto wrong = ecu::read_gain_changes(supervisor_.muscles(), names, gains, values, changes);
  if (wrong) return {false, *wrong};
  if (changes.empty()) return {true, ""};
  if (gains_.changing()) return {false, "gains are being changed already"};
  if (home_.running()) return {false, "home is running"};
  if (phase_ == Phase::kEnabling) return {false, "enable is in progress; try again in a second"};
  for (const ecu::GainChange& change : changes) {
    const int ecu = hardware_.muscles[static_cast<std::size_t>(change.gain.muscle)].ecu;
    const EcuLink& link = links_[static_cast<std::size_t>(ecu)];
    if (!link.alive()) return {false, link.own().name + ": does not answer"};
    if (phase_ == Phase::kDisabled && !link.configured())
      return {false, link.own().name + ": is being configured; try again in a second"};
  }
  gains_.start(std::move(changes), now);
  return {true, ""};
}

bool RobotDriver::Implementation::clearing(double now) const {
  if (!cleared_ || now - *cleared_ > kClearGrace) return false;
  return clear_repeats_ > 0 || not_cleared().has_value();
}

std::optional<std::string> RobotDriver::Implementation::not_cleared() const {
  for (const EcuLink& link : links_) {
    if (const auto left = link.not_cleared()) return link.own().name + ": " + *left;
  }
  return std::nullopt;
}

RobotDriver::Outcome RobotDriver::Implementation::disable() {
  ++halts_;
  home_.abort("disabled");
  phase_ = Phase::kDisabled;
  disable_repeats_ = kRepeats;
  for (ecu::MuscleReference& reference : references_) {
    reference.mode = ecu::Mode::kVoltage;
    reference.reference = 0.0;
  }
  request(Operation::kDisable, 0);
  watch_.sent(bus_.flush(), last_cycle_);
  supervisor_.disable();
  return {true, unconfirmed().value_or("")};
}

RobotDriver::Outcome RobotDriver::Implementation::emergency_stop() {
  home_.abort("emergency stop");
  if (phase_ == Phase::kEnabling) last_outcome_ = {false, "emergency stop"};
  ecu::Frame stop;
  send(stop);
  for (EcuLink& link : links_) link.stop_sent();
  clear_repeats_ = 0;
  disable();
  supervisor_.emergency_stop();
  return {true, unconfirmed().value_or("")};
}

std::optional<std::string> RobotDriver::Implementation::unconfirmed() const {
  const auto trouble = watch_.trouble();
  if (!trouble) return std::nullopt;
  return "the ECUs may not have received it: " + *trouble +
         ". Without references they stop by themselves";
}

}  // namespace driver
}  // namespace anthrob
