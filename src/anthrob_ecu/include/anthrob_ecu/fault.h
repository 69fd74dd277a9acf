#pragma once

#include <cstdint>

namespace anthrob {
namespace ecu {

/// The faults that an ECU can report; numbers as on the wire.
enum class Fault : std::uint8_t {
  kNone = 0,
  // These lead to State::kFault.
  kSelfTest = 1,
  kOverCurrent = 2,
  kOverForce = 3,
  kPositionLimit = 4,
  kOverSpeed = 5,
  kOverTemperature = 6,
  kSupplyLow = 7,
  kSupplyHigh = 8,
  kForceSensor = 9,
  kEncoder = 10,
  // These lead to State::kStopping, and only from State::kEnabled: the bus is at fault, not the
  // unit.
  kSyncLost = 11,
  kReferenceLost = 12,
  kBusOff = 13,
};
constexpr int kFaultCount = 14;

struct FaultInfo {
  Fault fault;
  const char* name;
  const char* meaning;
  const char* remedy;  ///< what the user should do
};

/// One row for each fault, in the order of their numbers.
extern const FaultInfo kFaults[kFaultCount];

/// Also works for numbers that do not exist.
const char* name(Fault fault);

constexpr bool stops_gently(Fault fault) {
  return fault == Fault::kSyncLost || fault == Fault::kReferenceLost || fault == Fault::kBusOff;
}

/// Whether the fault concerns the whole unit, not one of its muscles.
constexpr bool concerns_unit(Fault fault) {
  return stops_gently(fault) || fault == Fault::kSupplyLow || fault == Fault::kSupplyHigh;
}

/// Whether the spindle may have turned uncounted: positions mean nothing until `home`.
constexpr bool loses_zero(Fault fault) {
  return fault == Fault::kPositionLimit || fault == Fault::kOverSpeed || fault == Fault::kEncoder;
}

}  // namespace ecu
}  // namespace anthrob
