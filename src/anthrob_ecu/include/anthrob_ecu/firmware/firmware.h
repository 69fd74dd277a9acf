#pragma once

#include <array>

#include "anthrob_ecu/firmware/channel.h"
#include "anthrob_ecu/firmware/send_queue.h"
#include "anthrob_ecu/protocol.h"
#include "anthrob_ecu/state_machine.h"

namespace anthrob {
namespace ecu {

/// Identity and equipment of one board.
struct Wiring {
  int node = 1;              ///< on the bus
  int muscles = 2;           ///< 1 or 2
  int analogs = 0;           ///< 0..4 analogue inputs in use
  std::uint8_t session = 1;  ///< must differ from start to start
};

/// Everything that the board's peripherals read in one tick.
struct Readings {
  std::array<MuscleReadings, kMusclesPerEcu> muscle;
  std::array<std::uint16_t, kAnalogInputs> analog{};
  double supply = 12.0;  ///< [V]
  std::uint8_t transmit_errors = 0, receive_errors = 0;
  bool bus_off = false;  ///< of the CAN controller
};

/// The program of one ECU: frames in, frames out, one tick every millisecond. It uses no heap, no
/// exceptions and no operating system. It is fail-silent: it outputs volts only in State::kEnabled,
/// and only while valid SYNC and REFERENCE frames keep arriving.
///
/// The board must have a hardware watchdog that switches the power stage off if tick() is no longer
/// called.
class Firmware {
 public:
  /// [ticks] While enabled, this long without a valid SYNC or REFERENCE leads to zero volts.
  static constexpr int kWatchdogTicks = 15;
  static constexpr int kSelfTestTicks = 50;
  static constexpr int kStatePeriod = 100;   ///< [ticks]
  static constexpr int kHealthPeriod = 500;  ///< [ticks]

  explicit Firmware(const Wiring& wiring) : wiring_(wiring) {}

  /// A frame from the bus. Frames for other nodes are ignored.
  void receive(const Frame& frame);
  /// @return volts for the power stages
  std::array<double, kMusclesPerEcu> tick(const Readings& readings);
  /// @return false if nothing waits to be sent
  bool next_frame(Frame& frame) { return queue_.pop(frame); }

  State state() const { return machine_.state(); }
  Fault fault() const { return fault_; }
  bool stop_latched() const { return machine_.stop_latched(); }
  /// Whether a valid SYNC was ever received.
  bool sync_seen() const { return sync_seen_; }
  const Channel& channel(int muscle) const { return channels_[static_cast<std::size_t>(muscle)]; }

 private:
  void on_sync(const Sync& sync);
  void on_request(const Request& request);
  Refusal enable(const Request& request);
  Refusal clear();
  void on_reference(const Reference& reference);
  void on_parameter(const ParameterMessage& message);
  ParameterResult write(const ParameterMessage& message, Channel& channel);
  void self_test(const Readings& readings);
  void watch(const Readings& readings);
  void stop(Fault fault, int muscle);
  void handle(Event event);
  void report(const Readings& readings);
  void send_status(const Readings& readings);
  StateReport state_report() const;

  Wiring wiring_;
  StateMachine machine_;
  std::array<Channel, kMusclesPerEcu> channels_;
  SendQueue queue_;
  Fault fault_ = Fault::kNone;
  int fault_muscle_ = 0;
  Refusal refusal_ = Refusal::kAccepted;
  std::uint8_t sequence_ = 0;
  std::uint8_t refused_frames_ = 0;
  std::uint32_t ticks_ = 0;
  bool tested_ = false;            ///< by itself, after power-up
  int sync_age_ = kWatchdogTicks;  ///< [ticks]
  int reference_age_ = 0;
  bool sync_seen_ = false, sync_pending_ = false, reference_taken_ = false, state_changed_ = true;
  Sync sync_;
  Persistence supply_low_, supply_high_;
};

}  // namespace ecu
}  // namespace anthrob
