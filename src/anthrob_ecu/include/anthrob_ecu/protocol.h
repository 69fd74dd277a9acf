#pragma once

#include <cstdint>

#include "anthrob_ecu/control_law.h"
#include "anthrob_ecu/fault.h"
#include "anthrob_ecu/frame.h"
#include "anthrob_ecu/state_machine.h"

namespace anthrob {
namespace ecu {

/// The CAN protocol between host and ECUs, see docs/ecu_protocol.md.
/// identifier = function << 7 | node. Node 0 addresses all ECUs. A lower identifier is more urgent.
constexpr std::uint8_t kProtocolVersion = 1;
constexpr int kMaxNode = 127;
constexpr int kMusclesPerEcu = 2;
constexpr int kAnalogInputs = 4;

enum class Function : std::uint8_t {
  kStop = 0,       ///< host -> all; obeyed whatever its data
  kSync = 1,       ///< host -> all; heartbeat, and the instant to measure
  kRequest = 2,    ///< host -> one or all: enable, disable, clear
  kReference = 3,  ///< host -> one
  kMotionA = 4,    ///< ECU -> host, answers a SYNC; first muscle
  kMotionB = 5,    ///< the same, second muscle
  kEffort = 6,     ///< ECU -> host, answers a SYNC; both muscles
  kAnalog = 7,     ///< ECU -> host, answers every other SYNC
  kState = 8,      ///< ECU -> host, heartbeat every 100 ms and on every change
  kParameterRequest = 9,
  kParameterReply = 10,
  kHealth = 11,  ///< ECU -> host every 500 ms
};
constexpr int kFunctionCount = 12;

constexpr std::uint16_t identifier(Function function, int node) {
  return static_cast<std::uint16_t>(static_cast<int>(function) << 7 | node);
}
constexpr int function_of(const Frame& frame) {
  return frame.id >> 7;
}
constexpr int node_of(const Frame& frame) {
  return frame.id & 0x7F;
}

/// Data bytes of a function's frames; STOP may have any.
constexpr int kLengths[kFunctionCount] = {0, 4, 7, 8, 8, 8, 8, 8, 8, 8, 8, 8};

/// Whether a frame is accepted, or why not.
enum class Reading : std::uint8_t { kGood, kForeign, kWrongLength, kCorrupt };
/// Checks identifier, length and checksum only; the decoders read the rest.
Reading inspect(const Frame& frame);

enum class Operation : std::uint8_t { kEnable = 1, kDisable = 2, kClear = 3 };

/// Answer of an ECU to a request.
enum class Refusal : std::uint8_t {
  kAccepted = 0,
  kStopLatched = 1,
  kInFault = 2,
  kNotConfigured = 3,
  kWrongSession = 4,
  kNoSync = 5,
  kWrongVersion = 6,
  kUnknownOperation = 7,
  kSelfTest = 8,
};
constexpr int kRefusalCount = 9;
const char* name(Refusal refusal);

struct Sync {
  std::uint8_t counter = 0;
  std::uint8_t version = kProtocolVersion;
  bool enabled = false;  ///< what the host believes; for information only
};
Frame encode(const Sync& sync);
Sync decode_sync(const Frame& frame);

struct Request {
  Operation operation = Operation::kDisable;
  std::uint8_t sequence = 0;        ///< 1..255; 0 before the first
  std::uint8_t session = 0;         ///< of the ECU that is meant; counts for kEnable only
  std::uint16_t configuration = 0;  ///< checksum the host expects; counts for kEnable only
};
Frame encode(const Request& request, int node);
Request decode_request(const Frame& frame);

struct Reference {
  std::uint8_t counter = 0;  ///< low four bits of the last SYNC's
  Mode mode[kMusclesPerEcu] = {Mode::kVoltage, Mode::kVoltage};
  double reference[kMusclesPerEcu] = {0.0, 0.0};  ///< V, rad, A, N
};
Frame encode(const Reference& reference, int node);
Reference decode_reference(const Frame& frame);

struct Motion {
  std::uint8_t counter = 0;  ///< low four bits of the SYNC it answers
  State state = State::kBoot;
  bool stop_latched = false;
  double position = 0.0;  ///< [rad]
  double velocity = 0.0;  ///< [rad/s]
  double current = 0.0;   ///< [A]
};
Frame encode(const Motion& motion, int node, int muscle);
Motion decode_motion(const Frame& frame);

struct Effort {
  std::uint8_t counter = 0;
  double force[kMusclesPerEcu] = {0.0, 0.0};    ///< [N]; NaN: no sensor
  double voltage[kMusclesPerEcu] = {0.0, 0.0};  ///< [V]
};
Frame encode(const Effort& effort, int node);
Effort decode_effort(const Frame& frame);

/// A sensor that reads less or more is broken or disconnected [12-bit counts].
constexpr int kLowestCount = 8, kHighestCount = 4087;

struct Analog {
  std::uint8_t counter = 0;
  std::uint16_t count[kAnalogInputs] = {0, 0, 0, 0};  ///< 12 bits
};
Frame encode(const Analog& analog, int node);
Analog decode_analog(const Frame& frame);

struct StateReport {
  State state = State::kBoot;
  bool stop_latched = false;
  Fault fault = Fault::kNone;  ///< what stopped it last, until cleared
  int muscle = 0;              ///< which muscle that was
  Refusal refusal = Refusal::kAccepted;
  std::uint8_t sequence = 0;        ///< last request answered
  std::uint8_t session = 0;         ///< differs after every start
  std::uint16_t configuration = 0;  ///< checksum of all parameters
  std::uint8_t version = kProtocolVersion;
};
Frame encode(const StateReport& report, int node);
StateReport decode_state(const Frame& frame);

enum class ParameterResult : std::uint8_t {
  kOk = 0,
  kUnknown = 1,
  kOutOfRange = 2,
  kNotNow = 3,  ///< limits and calibration cannot be written while enabled
};
const char* name(ParameterResult result);

struct ParameterMessage {
  bool write = false;                             ///< of a request
  ParameterResult result = ParameterResult::kOk;  ///< of a reply
  std::uint8_t muscle = 0;
  std::uint8_t index = 0;
  std::uint8_t sequence = 0;
  float value = 0.0f;  ///< of a reply: what the ECU holds now
};
Frame encode_parameter_request(const ParameterMessage& message, int node);
Frame encode_parameter_reply(const ParameterMessage& message, int node);
ParameterMessage decode_parameter(const Frame& frame);

struct Health {
  int temperature[kMusclesPerEcu] = {0, 0};  ///< of the power stages [deg C]
  double supply = 0.0;                       ///< [V]
  std::uint8_t transmit_errors = 0;          ///< of the CAN controller
  std::uint8_t receive_errors = 0;
  std::uint8_t refused_frames = 0;  ///< wraps round
};
Frame encode(const Health& health, int node);
Health decode_health(const Frame& frame);

}  // namespace ecu
}  // namespace anthrob
