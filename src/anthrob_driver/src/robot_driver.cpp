#include "anthrob_driver/robot_driver.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace driver {

namespace {

using ecu::Function;
using ecu::Operation;

constexpr double kClearGrace = 0.15;  // [s] until ECUs have cleared their latches
constexpr int kIdleNode = -2;         // on the bus, but not used
constexpr int kRepeats = 3;           // cycles in which disable and clear are sent

ecu::Supervisor::Options supervisor_options(const RobotDriver::Options& options) {
  if (!(options.rate >= 100.0 && options.rate <= 1000.0)) {
    throw BadInput("rate: " + std::to_string(options.rate) +
                   ": expected 100 to 1000 Hz; ECUs stop after 15 ms without SYNC");
  }
  if (!(options.command_timeout > 0.0 && options.command_timeout <= 10.0)) {
    throw BadInput("command_timeout: " + std::to_string(options.command_timeout) +
                   ": expected a number above 0, up to 10 s");
  }
  if (!(options.first_step >= 0.0 && options.first_step <= 100.0)) {
    throw BadInput("first_step: " + std::to_string(options.first_step) +
                   ": expected 0 (no limit) to 100 rad");
  }
  ecu::Supervisor::Options result;
  result.command_timeout = options.command_timeout;
  result.auto_enable = false;  // hardware never enables itself
  return result;
}

std::vector<EcuLink> make_links(const Hardware& hardware, Findings& findings) {
  std::vector<EcuLink> links;
  for (std::size_t e = 0; e < hardware.ecus.size(); ++e) {
    links.emplace_back(hardware, static_cast<int>(e), findings);
  }
  return links;
}

std::string too_old(double age, double limit) {
  if (std::abs(age) <= limit) return "";
  char text[120];
  std::snprintf(text, sizeof(text),
                "sent %.1f s %s: a recording, or the clocks of two computers differ", std::abs(age),
                age > 0.0 ? "ago" : "ahead of time");
  return text;
}

}  // namespace

RobotDriver::RobotDriver(Hardware hardware, const Options& options, Bus& bus)
    : hardware_(std::move(hardware)),
      options_(options),
      bus_(bus),
      watch_(findings_, options.rate),
      supervisor_(hardware_.channels(), supervisor_options(options)),
      links_(make_links(hardware_, findings_)),
      link_of_node_(ecu::kMaxNode + 1, -1),
      sampler_(hardware_),
      first_step_(hardware_, options.first_step),
      home_(hardware_),
      zeros_(links_, supervisor_),
      gains_(hardware_, links_),
      stopping_(links_) {
  for (std::size_t e = 0; e < hardware_.ecus.size(); ++e) {
    link_of_node_[static_cast<std::size_t>(hardware_.ecus[e].node)] = static_cast<int>(e);
  }
  for (const int node : hardware_.idle_nodes) {
    link_of_node_[static_cast<std::size_t>(node)] = kIdleNode;
  }
  for (std::size_t m = 0; m < hardware_.muscles.size(); ++m) {
    references_.push_back({static_cast<int>(m), ecu::Mode::kVoltage, 0.0});
  }
  for (const MuscleHardware& muscle : hardware_.muscles) {
    muscles_.emplace_back(muscle, hardware_.tendons, hardware_.home.pretension);
  }
}

// ---- in ----

void RobotDriver::receive(const BusEvent& event, double now) {
  watch_.receive(event, now);
  if (event.kind == BusEvent::Kind::kEcho) {
    // The echo says when SYNC was on the wire: that is when the ECUs measured.
    const bool ours = ecu::function_of(event.frame) == static_cast<int>(Function::kSync) &&
                      event.frame.data[0] == counter_;
    if (ours) sampler_.on_wire(event.stamp_ns);
  } else if (event.kind == BusEvent::Kind::kFrame) {
    sampler_.on_frame(event.stamp_ns);
    on_frame(event.frame, now);
    if (sampler_.is_open() && all_complete()) sampler_.close(links_, supervisor_, now);
  }
}

void RobotDriver::on_frame(const ecu::Frame& frame, double now) {
  const int index = link_of_node_[static_cast<std::size_t>(ecu::node_of(frame))];
  const int who = index < 0 ? -1 : index;
  switch (ecu::inspect(frame)) {
    case ecu::Reading::kForeign:
      return findings_.add(Finding::kForeignFrame, who, now);
    case ecu::Reading::kWrongLength:
      return findings_.add(Finding::kWrongLength, who, now);
    case ecu::Reading::kCorrupt:
      return findings_.add(Finding::kCorruptFrame, who, now);
    case ecu::Reading::kGood:
      break;
  }
  if (ecu::function_of(frame) == static_cast<int>(Function::kStop)) {
    // Somebody else on the bus pressed stop.
    findings_.add(Finding::kStopLatched, -1, now);
    if (!supervisor_.stop_latched()) {
      obey_stop(-1);
    } else {
      // The latched STOP is already repeated each cycle; answering again would loop between two
      // hosts. But no call that came before it may undo it.
      ++halts_;
    }
    return;
  }
  if (ecu::function_of(frame) <= static_cast<int>(Function::kReference) ||
      ecu::function_of(frame) == static_cast<int>(Function::kParameterRequest)) {
    findings_.add(Finding::kSecondHost, -1, now);
    return stop(Finding::kSecondHost, -1);
  }
  if (index == kIdleNode) return;
  if (index < 0) return findings_.add(Finding::kForeignFrame, -1, now);
  EcuLink& link = links_[static_cast<std::size_t>(index)];
  link.receive(frame, now);
  if (link.take_analog()) sampler_.add_analog(link, index, now, findings_);
}

// ---- requests ----

RobotDriver::Outcome RobotDriver::command(const std::vector<std::string>& names,
                                          const std::vector<std::uint8_t>& modes,
                                          const std::vector<double>& references, double now,
                                          double age) {
  const std::string old = too_old(age, options_.command_timeout);
  if (!old.empty()) return refuse(old);
  if (home_.running()) return refuse("home is running");
  if (phase_ == Phase::kEnabled) {
    const std::string far =
        first_step_.too_far(names, modes, references, references_, sampler_.last());
    if (!far.empty()) return refuse(far);
  }
  // The time-out runs from when it was sent. A stamp in the future gains nothing.
  const Outcome outcome =
      supervisor_.command(names, modes, references, now - std::max(0.0, age), accepted_);
  if (!outcome.accepted) return outcome;
  for (const ecu::MuscleReference& reference : accepted_) {
    references_[static_cast<std::size_t>(reference.muscle)] = reference;
  }
  return outcome;
}

std::string RobotDriver::why_not_enable() const {
  if (supervisor_.stop_latched()) return "emergency stop is latched: call clear_faults first";
  if (!watch_.trouble().empty()) return watch_.trouble();
  if (gains_.changing()) return "gains are being changed; try again in a second";
  for (const EcuLink& link : links_) {
    const std::string who = link.own().name + ": ";
    if (supervisor_.state(link.own().muscles.front()) == ecu::State::kFault) {
      return who + "is in FAULT: call clear_faults first";
    }
    const std::string reason = link.why_not_enable();
    if (!reason.empty()) return who + reason;
  }
  for (const MuscleWatch& muscle : muscles_) {
    const std::string reason = muscle.why_not_enable();
    if (!reason.empty()) return reason;
  }
  return "";
}

RobotDriver::Outcome RobotDriver::start_enable(double now) {
  if (phase_ == Phase::kEnabled) return last_outcome_ = {true, "already enabled"};
  if (phase_ == Phase::kEnabling) return {true, "enabling"};
  name_stop(HUGE_VAL);
  const std::string reason = why_not_enable();
  if (!reason.empty()) {
    findings_.add(Finding::kEnableRefused, -1, now, reason);
    return last_outcome_ = {false, reason};
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

void RobotDriver::continue_enable(double now) {
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

void RobotDriver::finish_enable(bool success, const std::string& reason) {
  last_outcome_ = {success, reason};
  if (success) {
    phase_ = Phase::kEnabled;
    return;
  }
  findings_.add(Finding::kEnableRefused, -1, last_cycle_, reason);
  disable();
}

RobotDriver::Outcome RobotDriver::start_home(double now) {
  if (phase_ != Phase::kEnabled) return {false, "not enabled: call enable first"};
  if (home_.running()) return {false, "home is running already"};
  if (gains_.changing()) return {false, "gains are being changed; try again in a second"};
  home_.start(now);
  return {true, "homing"};
}

RobotDriver::Outcome RobotDriver::clear_faults(double now) {
  const Outcome outcome = supervisor_.clear_faults();
  if (phase_ != Phase::kDisabled) return outcome;
  name_stop(HUGE_VAL);
  findings_.clear();
  cleared_ = now;
  disable_repeats_ = 0;
  clear_repeats_ = kRepeats;
  return outcome;
}

RobotDriver::Outcome RobotDriver::start_gains(const std::vector<std::string>& names,
                                              const std::vector<std::string>& gains,
                                              const std::vector<double>& values, double now) {
  std::vector<ecu::GainChange> changes;
  const std::string wrong =
      ecu::read_gain_changes(supervisor_.muscles(), names, gains, values, changes);
  if (!wrong.empty()) return {false, wrong};
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

bool RobotDriver::clearing(double now) const {
  if (cleared_ < 0.0 || now - cleared_ > kClearGrace) return false;
  return clear_repeats_ > 0 || !not_cleared().empty();
}

std::string RobotDriver::not_cleared() const {
  for (const EcuLink& link : links_) {
    const std::string left = link.not_cleared();
    if (!left.empty()) return link.own().name + ": " + left;
  }
  return "";
}

// ---- stopping ----

RobotDriver::Outcome RobotDriver::disable() {
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
  return {true, unconfirmed()};
}

RobotDriver::Outcome RobotDriver::emergency_stop() {
  home_.abort("emergency stop");
  if (phase_ == Phase::kEnabling) last_outcome_ = {false, "emergency stop"};
  ecu::Frame stop;
  send(stop);
  for (EcuLink& link : links_) link.stop_sent();
  clear_repeats_ = 0;
  disable();
  supervisor_.emergency_stop();
  return {true, unconfirmed()};
}

std::string RobotDriver::unconfirmed() const {
  const std::string trouble = watch_.trouble();
  if (trouble.empty()) return "";
  return "the ECUs may not have received it: " + trouble +
         ". Without references they stop by themselves";
}

void RobotDriver::stop(Finding finding, int ecu, const std::string& detail) {
  if (phase_ == Phase::kDisabled) return;
  const std::string what = stopping_.reason(finding, ecu, detail);
  halt(finding, ecu, what);
  stopping_.record(finding, what);
}

void RobotDriver::stop_for_unit(Finding finding, int ecu, double now) {
  if (phase_ == Phase::kDisabled) return;
  name_stop(HUGE_VAL);  // record an earlier stop that still waits for its reason
  const std::string what = stopping_.reason(finding, ecu, stopping_.fault_of(ecu));
  halt(finding, ecu, what);
  stopping_.expect_reason(finding, ecu, what, now);
}

void RobotDriver::halt(Finding finding, int ecu, const std::string& what) {
  home_.abort(what);
  if (phase_ == Phase::kEnabling) finish_enable(false, what);
  disable();
  // The unit that failed must be cleared by the user; the others are only disabled.
  if (ecu >= 0 && finding != Finding::kEcuStopped)
    supervisor_.fault(links_[static_cast<std::size_t>(ecu)].own().name);
  last_outcome_ = {false, what};
}

void RobotDriver::name_stop(double now) {
  const std::optional<Stopping::Explained> stop = stopping_.take_reason(now);
  if (!stop) return;
  findings_.add(stop->finding, stop->ecu, last_cycle_, stop->fault);
  if (last_outcome_.reason == stop->told) last_outcome_ = {false, stop->what};
  stopping_.record(stop->finding, stop->what, stop->remedy);
}

void RobotDriver::obey_stop(int ecu) {
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

void RobotDriver::fail_home(double now) {
  findings_.add(Finding::kHomeFailed, -1, now, home_.failure());
  for (std::size_t m = 0; m < hardware_.muscles.size(); ++m) {
    if (home_.tendon_lost(m)) revoke_zero(hardware_.muscles[m]);
  }
  disable();
  last_outcome_ = {false, home_.failure()};
  stopping_.record(Finding::kHomeFailed, home_.failure());
}

void RobotDriver::revoke_zero(const MuscleHardware& muscle) {
  links_[static_cast<std::size_t>(muscle.ecu)].revoke_zero(muscle.channel);
}

// ---- watching ----

void RobotDriver::check_bus(double now) {
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
bool RobotDriver::bus_silent() const {
  const auto answered_once = [](const EcuLink& link) { return link.sample_time() > 0.0; };
  const auto missed = [](const EcuLink& link) { return !link.answered_last(); };
  const auto lost = [](const EcuLink& link) { return !link.alive(); };
  return links_.size() > 1 && std::all_of(links_.begin(), links_.end(), answered_once) &&
         std::all_of(links_.begin(), links_.end(), missed) &&
         std::any_of(links_.begin(), links_.end(), lost);
}

void RobotDriver::check_ecus(double now) {
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

void RobotDriver::check_muscles(double now) {
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

void RobotDriver::continue_home(double now) {
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

void RobotDriver::continue_zero(const std::vector<Home::Reading>& readings, double now) {
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

// ---- out ----

void RobotDriver::send(const ecu::Frame& frame) {
  watch_.sent(bus_.send(frame), last_cycle_);
}

std::uint8_t RobotDriver::request(Operation operation, int node, std::uint16_t configuration,
                                  std::uint8_t session) {
  // An ECU treats a repeated sequence number as the same request, so skip 0 (what an ECU reports
  // before any request) and all numbers last reported, which may be of a driver before this one.
  const auto is_used = [this](const EcuLink& link) { return link.report().sequence == sequence_; };
  do {
    ++sequence_;
  } while (sequence_ == 0 || std::any_of(links_.begin(), links_.end(), is_used));
  ecu::Request message;
  message.operation = operation;
  message.sequence = sequence_;
  message.session = session;
  message.configuration = configuration;
  send(ecu::encode(message, node));
  return sequence_;
}

void RobotDriver::cycle(double now) {
  if (cycles_ == 0) started_ = now;
  check_bus(now);
  last_cycle_ = now;
  if (watch_.condition() == BusWatch::Condition::kDown) bus_.recover();
  sampler_.close(links_, supervisor_, now);
  ++cycles_;
  ++counter_;
  for (EcuLink& link : links_) link.start_cycle(counter_, now);
  check_ecus(now);
  zeros_.update();
  // Commands are refused while homing, so their age must not trip the time-out.
  if (home_.running()) supervisor_.restart_watch(now);
  if (supervisor_.update(now)) {
    findings_.add(Finding::kCommandTimeout, -1, now);
    // STOPPING is what the ECUs report then, as on the simulator.
    stop(Finding::kCommandTimeout, -1);
  }
  check_muscles(now);
  if (phase_ == Phase::kEnabled) continue_home(now);
  send_cycle(now);
  if (phase_ == Phase::kEnabling) continue_enable(now);
  watch_.sent(bus_.flush(), now);
}

void RobotDriver::send_cycle(double now) {
  if (supervisor_.stop_latched()) send(ecu::Frame{});
  sampler_.open(references_, now);
  send(ecu::encode(ecu::Sync{counter_, ecu::kProtocolVersion, phase_ == Phase::kEnabled}));
  for (EcuLink& link : links_) {
    if (phase_ == Phase::kDisabled) break;
    ecu::Reference reference;
    reference.counter = static_cast<std::uint8_t>(counter_ & 0xF);
    for (std::size_t c = 0; c < link.own().muscles.size(); ++c) {
      const auto& wanted = references_[static_cast<std::size_t>(link.own().muscles[c])];
      reference.mode[c] = wanted.mode;
      reference.reference[c] = wanted.reference;
    }
    send(ecu::encode(reference, link.own().node));
  }
  if (disable_repeats_ > 0 && phase_ == Phase::kDisabled) {
    --disable_repeats_;
    request(Operation::kDisable, 0);
  }
  if (clear_repeats_ > 0) {
    --clear_repeats_;
    request(Operation::kClear, 0);
  }
  gains_.step(now, phase_ == Phase::kDisabled, [this](const ecu::Frame& frame) { send(frame); });
  send_parameters(now);
}

void RobotDriver::send_parameters(double now) {
  const bool disabled = phase_ == Phase::kDisabled;
  // Most is asked before enable. Questions about zeros that are left are sent at the rate of gain
  // writes, since REFERENCE frames have priority.
  if (!disabled &&
      (home_.running() || gains_.changing() || cycles_ % EcuLink::kCyclesPerWrite != 0)) {
    return;
  }
  for (EcuLink& link : links_) {
    ecu::Frame frame;
    const bool asks =
        (disabled && link.next_parameter(now, frame)) || link.next_zero_question(now, frame);
    if (!asks) continue;
    send(frame);
    if (!disabled) return;
  }
}

bool RobotDriver::all_complete() const {
  return std::all_of(links_.begin(), links_.end(),
                     [](const EcuLink& link) { return link.complete(); });
}

}  // namespace driver
}  // namespace anthrob
