#pragma once

#include "wire/bits.h"

namespace anthrob {
namespace ecu {

/// Where every number of the protocol lies. config/anthrob/anthrob_ecu.dbc says the same; a test
/// compares the two.
namespace layout {

// The last byte of every frame but STOP is the checksum.
namespace sync {
constexpr Field kCounter{0, 8}, kEnabled{8, 1}, kVersion{16, 8};
}
namespace request {
constexpr Field kOperation{0, 8}, kSequence{8, 8}, kSession{16, 8}, kConfiguration{32, 16};
}
namespace reference {
constexpr Field kCounter{0, 4}, kMode[] = {{4, 2}, {6, 2}};
/// By muscle and mode: V, rad, A, N.
constexpr double kScale[] = {1e-5, 1e-5, 1e-5, 1e-4};
constexpr Field value(int muscle, int mode) {
  return {muscle == 0 ? 8 : 32, 24, true, kScale[mode]};
}
}  // namespace reference
namespace motion {
constexpr Field kCounter{0, 4}, kState{4, 3}, kLatched{7, 1};
constexpr Field kPosition{8, 22, true, 2.5e-5};   // [rad]
constexpr Field kVelocity{30, 14, true, 2.5e-3};  // [rad/s]
constexpr Field kCurrent{44, 12, true, 0.01};     // [A]
}  // namespace motion
namespace effort {
constexpr Field kCounter{0, 4};
constexpr Field kForce[] = {{4, 14, false, 0.02}, {30, 14, false, 0.02}};   // [N]
constexpr Field kVoltage[] = {{18, 12, true, 0.01}, {44, 12, true, 0.01}};  // [V]
constexpr unsigned kNoForce = 0x3FFF;                                       // no sensor
}  // namespace effort
namespace analog {
constexpr Field kCounter{0, 4}, kCount[] = {{4, 12}, {16, 12}, {28, 12}, {40, 12}};
}
namespace state {
constexpr Field kState{0, 3}, kLatched{3, 1}, kRefusal{4, 4}, kFault{8, 7}, kMuscle{15, 1};
constexpr Field kSequence{16, 8}, kSession{24, 8}, kConfiguration{32, 16}, kVersion{48, 8};
}  // namespace state
namespace parameter {
constexpr Field kCode{0, 4}, kMuscle{4, 4}, kIndex{8, 8}, kSequence{16, 8}, kValue{24, 32};
}
namespace health {
constexpr Field kTemperature[] = {{0, 8, true}, {8, 8, true}};  // [deg C]
constexpr Field kSupply{16, 8, false, 0.1};                     // [V]
constexpr Field kTransmitErrors{24, 8}, kReceiveErrors{32, 8}, kRefused{40, 8};
}  // namespace health

}  // namespace layout
}  // namespace ecu
}  // namespace anthrob
