#include "anthrob_ecu/protocol.h"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#include "wire/wire_layout.h"

namespace anthrob {
namespace ecu {

namespace {

Frame blank(Function function, int node) {
  Frame frame;
  frame.id = identifier(function, node);
  frame.length = static_cast<std::uint8_t>(kLengths[static_cast<int>(function)]);
  return frame;
}

Frame sealed(Frame frame) {
  frame.data[static_cast<std::size_t>(frame.length - 1)] = checksum(frame);
  return frame;
}

template <class T>
T as(const Frame& frame, const Field& field) {
  return static_cast<T>(get_raw(frame, field));
}

template <class T>
void put_code(Frame& frame, const Field& field, T code) {
  put_raw(frame, field, static_cast<std::uint64_t>(code));
}

State state_from(std::uint64_t raw) {
  // A state that does not exist counts as a fault: it follows no references.
  return raw < kStateCount ? static_cast<State>(raw) : State::kFault;
}

Frame encode_parameter(Function function, std::uint64_t code, const ParameterMessage& m, int node) {
  using namespace layout::parameter;
  Frame frame = blank(function, node);
  std::uint32_t bits;
  std::memcpy(&bits, &m.value, sizeof(bits));
  put_code(frame, kCode, code);
  put_code(frame, kMuscle, m.muscle);
  put_code(frame, kIndex, m.index);
  put_code(frame, kSequence, m.sequence);
  put_raw(frame, kValue, bits);
  return sealed(frame);
}

}  // namespace

Reading inspect(const Frame& frame) {
  const int function = function_of(frame);
  if (frame.id > 0x7FF || function >= kFunctionCount) return Reading::kForeign;
  if (function == static_cast<int>(Function::kStop)) {
    return node_of(frame) == 0 ? Reading::kGood : Reading::kForeign;
  }
  if (frame.length != kLengths[function]) return Reading::kWrongLength;
  const bool intact = frame.data[static_cast<std::size_t>(frame.length - 1)] == checksum(frame);
  return intact ? Reading::kGood : Reading::kCorrupt;
}

Frame encode(const Sync& sync) {
  using namespace layout::sync;
  Frame frame = blank(Function::kSync, 0);
  put_code(frame, kCounter, sync.counter);
  put_code(frame, kEnabled, sync.enabled);
  put_code(frame, kVersion, sync.version);
  return sealed(frame);
}

Sync decode_sync(const Frame& frame) {
  using namespace layout::sync;
  return {as<std::uint8_t>(frame, kCounter), as<std::uint8_t>(frame, kVersion),
          as<bool>(frame, kEnabled)};
}

Frame encode(const Request& request, int node) {
  using namespace layout::request;
  Frame frame = blank(Function::kRequest, node);
  put_code(frame, kOperation, request.operation);
  put_code(frame, kSequence, request.sequence);
  put_code(frame, kSession, request.session);
  put_code(frame, kConfiguration, request.configuration);
  return sealed(frame);
}

Request decode_request(const Frame& frame) {
  using namespace layout::request;
  return {static_cast<Operation>(get_raw(frame, kOperation)), as<std::uint8_t>(frame, kSequence),
          as<std::uint8_t>(frame, kSession), as<std::uint16_t>(frame, kConfiguration)};
}

Frame encode(const Reference& reference, int node) {
  using namespace layout::reference;
  Frame frame = blank(Function::kReference, node);
  put_code(frame, kCounter, reference.counter);
  for (int m = 0; m < kMusclesPerEcu; ++m) {
    put_code(frame, kMode[m], reference.mode[m]);
    put(frame, value(m, static_cast<int>(reference.mode[m])), reference.reference[m]);
  }
  return sealed(frame);
}

Reference decode_reference(const Frame& frame) {
  using namespace layout::reference;
  Reference reference;
  reference.counter = as<std::uint8_t>(frame, kCounter);
  for (int m = 0; m < kMusclesPerEcu; ++m) {
    const auto mode = get_raw(frame, kMode[m]);
    reference.mode[m] = static_cast<Mode>(mode);
    reference.reference[m] = get(frame, value(m, static_cast<int>(mode)));
  }
  return reference;
}

Frame encode(const Motion& motion, int node, int muscle) {
  using namespace layout::motion;
  Frame frame = blank(muscle == 0 ? Function::kMotionA : Function::kMotionB, node);
  put_code(frame, kCounter, motion.counter);
  put_code(frame, kState, motion.state);
  put_code(frame, kLatched, motion.stop_latched);
  put(frame, kPosition, motion.position);
  put(frame, kVelocity, motion.velocity);
  put(frame, kCurrent, motion.current);
  return sealed(frame);
}

Motion decode_motion(const Frame& frame) {
  using namespace layout::motion;
  return {as<std::uint8_t>(frame, kCounter),
          state_from(get_raw(frame, kState)),
          as<bool>(frame, kLatched),
          get(frame, kPosition),
          get(frame, kVelocity),
          get(frame, kCurrent)};
}

Frame encode(const Effort& effort, int node) {
  using namespace layout::effort;
  Frame frame = blank(Function::kEffort, node);
  put_code(frame, kCounter, effort.counter);
  for (int m = 0; m < kMusclesPerEcu; ++m) {
    // One step below the code for "no sensor".
    const double most = kForce[m].highest() - kForce[m].scale;
    const double force = effort.force[m];
    if (std::isnan(force)) {
      put_raw(frame, kForce[m], kNoForce);
    } else {
      put(frame, kForce[m], force < most ? force : most);
    }
    put(frame, kVoltage[m], effort.voltage[m]);
  }
  return sealed(frame);
}

Effort decode_effort(const Frame& frame) {
  using namespace layout::effort;
  Effort effort;
  effort.counter = as<std::uint8_t>(frame, kCounter);
  for (int m = 0; m < kMusclesPerEcu; ++m) {
    effort.force[m] = get_raw(frame, kForce[m]) == kNoForce
                          ? std::numeric_limits<double>::quiet_NaN()
                          : get(frame, kForce[m]);
    effort.voltage[m] = get(frame, kVoltage[m]);
  }
  return effort;
}

Frame encode(const Analog& analog, int node) {
  using namespace layout::analog;
  Frame frame = blank(Function::kAnalog, node);
  put_code(frame, kCounter, analog.counter);
  for (int i = 0; i < kAnalogInputs; ++i) put_code(frame, kCount[i], analog.count[i]);
  return sealed(frame);
}

Analog decode_analog(const Frame& frame) {
  using namespace layout::analog;
  Analog analog;
  analog.counter = as<std::uint8_t>(frame, kCounter);
  for (int i = 0; i < kAnalogInputs; ++i) analog.count[i] = as<std::uint16_t>(frame, kCount[i]);
  return analog;
}

Frame encode(const StateReport& report, int node) {
  using namespace layout::state;
  Frame frame = blank(Function::kState, node);
  put_code(frame, kState, report.state);
  put_code(frame, kLatched, report.stop_latched);
  put_code(frame, kRefusal, report.refusal);
  put_code(frame, kFault, report.fault);
  put_code(frame, kMuscle, report.muscle);
  put_code(frame, kSequence, report.sequence);
  put_code(frame, kSession, report.session);
  put_code(frame, kConfiguration, report.configuration);
  put_code(frame, kVersion, report.version);
  return sealed(frame);
}

StateReport decode_state(const Frame& frame) {
  using namespace layout::state;
  StateReport report;
  report.state = state_from(get_raw(frame, kState));
  report.stop_latched = as<bool>(frame, kLatched);
  report.refusal = static_cast<Refusal>(get_raw(frame, kRefusal));
  report.fault = static_cast<Fault>(get_raw(frame, kFault));
  report.muscle = as<int>(frame, kMuscle);
  report.sequence = as<std::uint8_t>(frame, kSequence);
  report.session = as<std::uint8_t>(frame, kSession);
  report.configuration = as<std::uint16_t>(frame, kConfiguration);
  report.version = as<std::uint8_t>(frame, kVersion);
  return report;
}

Frame encode_parameter_request(const ParameterMessage& message, int node) {
  return encode_parameter(Function::kParameterRequest, message.write ? 1 : 0, message, node);
}

Frame encode_parameter_reply(const ParameterMessage& message, int node) {
  return encode_parameter(Function::kParameterReply, static_cast<std::uint64_t>(message.result),
                          message, node);
}

ParameterMessage decode_parameter(const Frame& frame) {
  using namespace layout::parameter;
  ParameterMessage message;
  const auto code = get_raw(frame, kCode);
  message.write = code == 1;
  message.result = static_cast<ParameterResult>(code);
  message.muscle = as<std::uint8_t>(frame, kMuscle);
  message.index = as<std::uint8_t>(frame, kIndex);
  message.sequence = as<std::uint8_t>(frame, kSequence);
  const auto bits = as<std::uint32_t>(frame, kValue);
  std::memcpy(&message.value, &bits, sizeof(bits));
  return message;
}

Frame encode(const Health& health, int node) {
  using namespace layout::health;
  Frame frame = blank(Function::kHealth, node);
  for (int m = 0; m < kMusclesPerEcu; ++m) put(frame, kTemperature[m], health.temperature[m]);
  put(frame, kSupply, health.supply);
  put_code(frame, kTransmitErrors, health.transmit_errors);
  put_code(frame, kReceiveErrors, health.receive_errors);
  put_code(frame, kRefused, health.refused_frames);
  return sealed(frame);
}

Health decode_health(const Frame& frame) {
  using namespace layout::health;
  Health health;
  for (int m = 0; m < kMusclesPerEcu; ++m) {
    health.temperature[m] = static_cast<int>(get(frame, kTemperature[m]));
  }
  health.supply = get(frame, kSupply);
  health.transmit_errors = as<std::uint8_t>(frame, kTransmitErrors);
  health.receive_errors = as<std::uint8_t>(frame, kReceiveErrors);
  health.refused_frames = as<std::uint8_t>(frame, kRefused);
  return health;
}

const char* name(Refusal refusal) {
  constexpr const char* kNames[kRefusalCount] = {
      "accepted", "stop_latched",  "in_fault",          "not_configured", "wrong_session",
      "no_sync",  "wrong_version", "unknown_operation", "self_test"};
  const auto index = static_cast<std::size_t>(refusal);
  return index < kRefusalCount ? kNames[index] : "unknown_refusal";
}

const char* name(ParameterResult result) {
  constexpr const char* kNames[] = {"ok", "unknown parameter", "out of range", "not while enabled"};
  const auto index = static_cast<std::size_t>(result);
  return index < 4 ? kNames[index] : "unknown result";
}

}  // namespace ecu
}  // namespace anthrob
