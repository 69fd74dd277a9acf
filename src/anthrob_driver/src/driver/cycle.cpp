// What comes in from the bus, and what goes out in every cycle.
#include <algorithm>

#include "anthrob_core/errors.h"
#include "driver/implementation.h"

namespace anthrob {
namespace driver {

namespace {

using ecu::Function;
using ecu::Operation;

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

}  // namespace

RobotDriver::Implementation::Implementation(Hardware hardware, const Options& options, Bus& bus)
    : hardware_(std::move(hardware)),
      options_(options),
      bus_(bus),
      watch_(findings_, options.rate),
      supervisor_(hardware_.channels(), supervisor_options(options)),
      links_(make_links(hardware_, findings_)),
      by_node_(ecu::kMaxNode + 1),
      sampler_(hardware_),
      first_step_(hardware_, options.first_step),
      home_(hardware_),
      zeros_(links_, supervisor_),
      gains_(hardware_, links_),
      stopping_(links_) {
  for (std::size_t e = 0; e < hardware_.ecus.size(); ++e) {
    by_node_[static_cast<std::size_t>(hardware_.ecus[e].node)] = {Addressee::Kind::kLinked,
                                                                  static_cast<int>(e)};
  }
  for (const int node : hardware_.idle_nodes) {
    by_node_[static_cast<std::size_t>(node)] = {Addressee::Kind::kIdle, std::nullopt};
  }
  for (std::size_t m = 0; m < hardware_.muscles.size(); ++m) {
    references_.push_back({static_cast<int>(m), ecu::Mode::kVoltage, 0.0});
  }
  for (const MuscleHardware& muscle : hardware_.muscles) {
    muscles_.emplace_back(muscle, hardware_.tendons, hardware_.home.pretension);
  }
}

void RobotDriver::Implementation::receive(const BusEvent& event, double now) {
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

void RobotDriver::Implementation::on_frame(const ecu::Frame& frame, double now) {
  const auto [kind, index] = by_node_[static_cast<std::size_t>(ecu::node_of(frame))];
  switch (ecu::inspect(frame)) {
    case ecu::Reading::kForeign:
      return findings_.add(Finding::kForeignFrame, index, now);
    case ecu::Reading::kWrongLength:
      return findings_.add(Finding::kWrongLength, index, now);
    case ecu::Reading::kCorrupt:
      return findings_.add(Finding::kCorruptFrame, index, now);
    case ecu::Reading::kGood:
      break;
  }
  if (ecu::function_of(frame) == static_cast<int>(Function::kStop)) {
    // Somebody else on the bus pressed stop.
    if (!supervisor_.stop_latched()) {
      return stop(stopping_rule(Finding::kStopLatched, NoticedBy::kFrame), std::nullopt, now);
    }
    // The latched STOP is already repeated each cycle; answering again would loop between two
    // hosts. But no call that came before it may undo it.
    findings_.add(Finding::kStopLatched, std::nullopt, now);
    ++halts_;
    return;
  }
  if (ecu::function_of(frame) <= static_cast<int>(Function::kReference) ||
      ecu::function_of(frame) == static_cast<int>(Function::kParameterRequest)) {
    return stop(stopping_rule(Finding::kSecondHost, NoticedBy::kFrame), std::nullopt, now);
  }
  if (kind == Addressee::Kind::kIdle) return;
  if (!index) return findings_.add(Finding::kForeignFrame, std::nullopt, now);
  EcuLink& link = links_[static_cast<std::size_t>(*index)];
  link.receive(frame, now);
  if (link.take_analog()) sampler_.add_analog(link, *index, now, findings_);
}

void RobotDriver::Implementation::send(const ecu::Frame& frame) {
  watch_.sent(bus_.send(frame), last_cycle_);
}

std::uint8_t RobotDriver::Implementation::request(Operation operation, int node,
                                                  std::uint16_t configuration,
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

void RobotDriver::Implementation::cycle(double now) {
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
    // STOPPING is what the ECUs report then, as on the simulator.
    stop(stopping_rule(Finding::kCommandTimeout, NoticedBy::kSupervisor), std::nullopt, now);
  }
  check_muscles(now);
  if (phase_ == Phase::kEnabled) continue_home(now);
  send_cycle(now);
  if (phase_ == Phase::kEnabling) continue_enable(now);
  watch_.sent(bus_.flush(), now);
}

void RobotDriver::Implementation::send_cycle(double now) {
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

void RobotDriver::Implementation::send_parameters(double now) {
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

bool RobotDriver::Implementation::all_complete() const {
  return std::all_of(links_.begin(), links_.end(),
                     [](const EcuLink& link) { return link.complete(); });
}

}  // namespace driver
}  // namespace anthrob
