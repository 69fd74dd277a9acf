#include "anthrob_ecu/firmware/firmware.h"

namespace anthrob {
namespace ecu {

namespace {
constexpr double kLowestSupply = 9.0, kHighestSupply = 20.0;  // [V]
constexpr int kSupplyTicks = 10;
/// A SYNC may be this much ahead of the last one; what is further is an old frame come again.
constexpr int kLargestGap = 8;
}  // namespace

void Firmware::receive(const Frame& frame) {
  const int function = function_of(frame), node = node_of(frame);
  const bool mine = node == 0 || node == wiring_.node;
  if (!mine || function >= kFunctionCount) return;
  const Reading reading = inspect(frame);
  if (reading == Reading::kForeign) return;
  if (reading != Reading::kGood) {
    ++refused_frames_;
    return;
  }
  switch (static_cast<Function>(function)) {
    case Function::kStop:
      handle(Event::kEmergencyStop);
      break;
    case Function::kSync:
      if (node == 0) on_sync(decode_sync(frame));
      break;
    case Function::kRequest:
      on_request(decode_request(frame));
      break;
    case Function::kReference:
      if (node != 0) on_reference(decode_reference(frame));
      break;
    case Function::kParameterRequest:
      if (node != 0) on_parameter(decode_parameter(frame));
      break;
    default:
      // Somebody else speaks with this unit's identifier.
      ++refused_frames_;
  }
}

void Firmware::on_sync(const Sync& sync) {
  const int ahead = static_cast<std::uint8_t>(sync.counter - sync_.counter);
  const bool stale = sync_seen_ && (ahead == 0 || ahead > kLargestGap);
  // After a silence any counter will do: the motors are off then.
  if (sync.version != kProtocolVersion || (stale && sync_age_ < kWatchdogTicks)) {
    ++refused_frames_;
    return;
  }
  sync_ = sync;
  sync_seen_ = sync_pending_ = true;
  reference_taken_ = false;
  sync_age_ = 0;
}

Refusal Firmware::enable(const Request& request) {
  if (machine_.state() == State::kBoot) return Refusal::kSelfTest;
  if (request.session != wiring_.session) return Refusal::kWrongSession;
  if (machine_.stop_latched()) return Refusal::kStopLatched;
  if (machine_.state() == State::kFault) return Refusal::kInFault;
  if (sync_age_ >= kWatchdogTicks) return Refusal::kNoSync;
  if (request.configuration != state_report().configuration) return Refusal::kNotConfigured;
  fault_ = Fault::kNone;
  handle(Event::kEnable);
  reference_age_ = 0;
  return Refusal::kAccepted;
}

Refusal Firmware::clear() {
  // Nothing to clear while it runs; a stop or a fault is cleared into idle. Not before the self
  // test, whatever came up meanwhile, and what that found only the next power-up can take back.
  if (machine_.state() == State::kEnabled) return Refusal::kAccepted;
  if (!tested_ || fault_ == Fault::kSelfTest) return Refusal::kSelfTest;
  handle(Event::kClear);
  fault_ = Fault::kNone;
  return Refusal::kAccepted;
}

void Firmware::on_request(const Request& request) {
  // The same request again is answered again, but done once: an old enable must not undo a stop,
  // nor an old clear what came after it.
  const bool repeated = request.sequence == sequence_;
  state_changed_ = true;
  if (repeated && request.operation != Operation::kDisable) return;
  sequence_ = request.sequence;
  switch (request.operation) {
    case Operation::kEnable:
      refusal_ = enable(request);
      return;
    case Operation::kDisable:
      handle(Event::kDisable);
      refusal_ = Refusal::kAccepted;
      return;
    case Operation::kClear:
      refusal_ = clear();
      return;
  }
  refusal_ = Refusal::kUnknownOperation;
}

void Firmware::on_reference(const Reference& reference) {
  // Only the reference that belongs to the last SYNC, and only once: old ones do not count.
  const bool fresh =
      sync_age_ < kWatchdogTicks && !reference_taken_ && reference.counter == (sync_.counter & 0xF);
  bool good = fresh;
  if (fresh && machine_.follows_references()) {
    for (int m = 0; m < wiring_.muscles; ++m) {
      good =
          channels_[static_cast<std::size_t>(m)].refer(reference.mode[m], reference.reference[m]) &&
          good;
    }
  }
  if (!good) {
    ++refused_frames_;
    return;
  }
  reference_taken_ = true;
  reference_age_ = 0;
}

ParameterResult Firmware::write(const ParameterMessage& message, Channel& channel) {
  if (message.index == kPresentPosition) {
    if (!(message.value >= -50.0f && message.value <= 50.0f)) return ParameterResult::kOutOfRange;
    // A moved zero would make a muscle jump that follows positions.
    if (machine_.follows_references() && channel.mode() == Mode::kPosition) {
      return ParameterResult::kNotNow;
    }
    channel.set_position(message.value);
    return ParameterResult::kOk;
  }
  if (message.index == kZeroKnown) {
    // A zero comes with a position only.
    if (message.value != 0.0f) return ParameterResult::kOutOfRange;
    channel.lose_zero();
    return ParameterResult::kOk;
  }
  if (message.index >= kParameterCount) return ParameterResult::kUnknown;
  if (machine_.follows_references() && !kParameters[message.index].live) {
    return ParameterResult::kNotNow;
  }
  if (!channel.parameters.set(message.index, message.value)) return ParameterResult::kOutOfRange;
  if (!kParameters[message.index].live) channel.reconfigure();
  return ParameterResult::kOk;
}

void Firmware::on_parameter(const ParameterMessage& message) {
  ParameterMessage reply = message;
  if (message.muscle >= wiring_.muscles) {
    reply.result = ParameterResult::kUnknown;
  } else {
    Channel& channel = channels_[message.muscle];
    const bool known = message.index < kParameterCount || message.index == kPresentPosition ||
                       message.index == kZeroKnown;
    reply.result = message.write ? write(message, channel)
                   : known       ? ParameterResult::kOk
                                 : ParameterResult::kUnknown;
    if (message.index < kParameterCount) {
      reply.value = channel.parameters.raw(message.index);
    } else if (message.index == kPresentPosition) {
      reply.value = static_cast<float>(channel.measured().position);
    } else if (message.index == kZeroKnown) {
      reply.value = channel.zero_known() ? 1.0f : 0.0f;
    }
  }
  queue_.push(encode_parameter_reply(reply, wiring_.node));
}

void Firmware::handle(Event event) {
  const State before = machine_.state();
  const bool latched = machine_.stop_latched();
  machine_.handle(event);
  state_changed_ =
      state_changed_ || machine_.state() != before || machine_.stop_latched() != latched;
  if (!machine_.follows_references()) {
    for (Channel& channel : channels_) channel.release();
  }
}

void Firmware::stop(Fault fault, int muscle) {
  if (machine_.state() == State::kFault) return;
  if (stops_gently(fault) && !machine_.follows_references()) return;
  fault_ = fault;
  fault_muscle_ = muscle;
  handle(stops_gently(fault) ? Event::kCommandTimeout : Event::kFaultDetected);
}

void Firmware::watch(const Readings& readings) {
  if (sync_age_ < kWatchdogTicks) ++sync_age_;
  if (reference_age_ < kWatchdogTicks) ++reference_age_;
  if (readings.bus_off) stop(Fault::kBusOff, 0);
  if (sync_age_ >= kWatchdogTicks) stop(Fault::kSyncLost, 0);
  if (reference_age_ >= kWatchdogTicks) stop(Fault::kReferenceLost, 0);
  if (supply_low_.lasted(readings.supply < kLowestSupply, kSupplyTicks)) stop(Fault::kSupplyLow, 0);
  if (supply_high_.lasted(readings.supply > kHighestSupply, kSupplyTicks)) {
    stop(Fault::kSupplyHigh, 0);
  }
}

void Firmware::self_test(const Readings& readings) {
  tested_ = true;
  for (int m = 0; m < wiring_.muscles; ++m) {
    const int current = readings.muscle[static_cast<std::size_t>(m)].current;
    if (current >= kLowestCount && current <= kHighestCount) continue;
    // Wins over a fault that came up while booting: that one could be cleared.
    fault_ = Fault::kSelfTest;
    fault_muscle_ = m;
    state_changed_ = true;
    return handle(Event::kFaultDetected);
  }
  handle(Event::kSelfTestPassed);
}

std::array<double, kMusclesPerEcu> Firmware::tick(const Readings& readings) {
  ++ticks_;
  if (!tested_ && ticks_ >= kSelfTestTicks) self_test(readings);
  watch(readings);
  for (int m = 0; m < wiring_.muscles; ++m) {
    const auto i = static_cast<std::size_t>(m);
    const Fault fault = channels_[i].measure(readings.muscle[i]);
    if (loses_zero(fault)) channels_[i].lose_zero();
    if (fault != Fault::kNone) stop(fault, m);
  }
  std::array<double, kMusclesPerEcu> volts{};
  if (machine_.follows_references()) {
    for (int m = 0; m < wiring_.muscles; ++m) {
      const auto i = static_cast<std::size_t>(m);
      volts[i] = channels_[i].follow();
    }
  }
  report(readings);
  return volts;
}

void Firmware::report(const Readings& readings) {
  // Bus-off: what waits is old by the time the bus is back.
  if (readings.bus_off) queue_.clear();
  if (sync_pending_) send_status(readings);
  sync_pending_ = false;
  if (state_changed_ || ticks_ % kStatePeriod == 0) {
    queue_.push(encode(state_report(), wiring_.node));
    state_changed_ = false;
  }
  if (ticks_ % kHealthPeriod == 0) {
    Health health;
    for (int m = 0; m < kMusclesPerEcu; ++m) {
      health.temperature[m] = readings.muscle[static_cast<std::size_t>(m)].temperature;
    }
    health.supply = readings.supply;
    health.transmit_errors = readings.transmit_errors;
    health.receive_errors = readings.receive_errors;
    health.refused_frames = refused_frames_;
    queue_.push(encode(health, wiring_.node));
  }
}

void Firmware::send_status(const Readings& readings) {
  const auto counter = static_cast<std::uint8_t>(sync_.counter & 0xF);
  Effort effort;
  effort.counter = counter;
  for (int m = 0; m < wiring_.muscles; ++m) {
    const Channel& c = channel(m);
    const Motion motion{counter,
                        machine_.state(),
                        machine_.stop_latched(),
                        c.measured().position,
                        c.measured().velocity,
                        c.measured().current};
    queue_.push(encode(motion, wiring_.node, m));
    effort.force[m] = c.force_or_nan();
    effort.voltage[m] = c.voltage();
  }
  queue_.push(encode(effort, wiring_.node));
  if (wiring_.analogs > 0 && (sync_.counter & 1) == 0) {
    Analog analog;
    analog.counter = counter;
    for (int i = 0; i < wiring_.analogs; ++i) {
      analog.count[i] = readings.analog[static_cast<std::size_t>(i)];
    }
    queue_.push(encode(analog, wiring_.node));
  }
}

StateReport Firmware::state_report() const {
  StateReport report;
  report.state = machine_.state();
  report.stop_latched = machine_.stop_latched();
  report.fault = fault_;
  report.muscle = fault_muscle_;
  report.refusal = refusal_;
  report.sequence = sequence_;
  report.session = wiring_.session;
  ParameterSet sets[kMusclesPerEcu];
  for (int m = 0; m < wiring_.muscles; ++m) sets[m] = channel(m).parameters;
  report.configuration = configuration_checksum(sets, wiring_.muscles);
  return report;
}

}  // namespace ecu
}  // namespace anthrob
