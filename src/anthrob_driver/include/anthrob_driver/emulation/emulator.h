#pragma once

#include <functional>
#include <string>

#include "anthrob_driver/bus/socketcan_bus.h"
#include "anthrob_driver/emulation/rack.h"

namespace anthrob {
namespace driver {

/// Refuses to emulate on a physical interface: emulated ECUs would answer with the node numbers of
/// a robot's ECUs, and the programs that emulate clear its emergency stop.
/// @param physical the user has allowed a physical interface
/// @throws BadInput if the interface is not a virtual one (vcan...), unless `physical`
void refuse_physical_bus(const std::string& interface, bool physical);

/// Runs a rack of emulated ECUs on a CAN interface in real time. If the machine is too slow, ticks
/// take longer, but none is left out: the ECUs' watchdogs count their own ticks.
class Emulator {
 public:
  /// For become_realtime: above the driver's, as real ECUs do not wait for the host.
  static constexpr int kPriority = 70;

  /// @param pace below 1: time runs slower, as DriverThread's
  Emulator(Rack& rack, SocketCanBus& bus, double pace = 1.0)
      : rack_(rack), bus_(bus), period_(0.001 / pace) {}

  /// @param quit ends the loop   @param each_tick called after every millisecond
  void run(const std::function<bool()>& quit, const std::function<void()>& each_tick);
  /// Ticks that were more than five milliseconds late.
  std::uint64_t late() const { return late_; }

 private:
  Rack& rack_;
  SocketCanBus& bus_;
  double period_;  ///< [s] of a tick
  std::uint64_t late_ = 0;
};

}  // namespace driver
}  // namespace anthrob
