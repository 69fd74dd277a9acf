#pragma once

#include <functional>
#include <string>

#include "anthrob_driver/bus/socketcan_bus.h"
#include "anthrob_driver/emulation/rack.h"

namespace anthrob {
namespace driver {

/// Emulated units beside a robot would answer with its units' numbers, and who emulates clears its
/// emergency stop.
/// @param physical the user has asked for it
/// @throws BadInput if the interface is none of the virtual ones (vcan...)
void refuse_physical_bus(const std::string& interface, bool physical);

/// Runs a rack of emulated ECUs on a CAN interface in real time. When the machine is too slow,
/// its milliseconds get longer rather than fewer: the ECUs' watchdogs count their own ticks.
class Emulator {
 public:
  /// For become_realtime: above the driver's, as real ECUs do not wait for the host.
  static constexpr int kPriority = 70;

  /// @param pace below 1: time runs slower, as DriverThread's
  Emulator(Rack& rack, SocketCanBus& bus, double pace = 1.0)
      : rack_(rack), bus_(bus), period_(0.001 / pace) {}

  /// @param quit ends the loop   @param each_tick called after every millisecond
  void run(const std::function<bool()>& quit, const std::function<void()>& each_tick);
  /// Milliseconds that took longer.
  std::uint64_t late() const { return late_; }

 private:
  Rack& rack_;
  SocketCanBus& bus_;
  double period_;  ///< [s] of a tick
  std::uint64_t late_ = 0;
};

}  // namespace driver
}  // namespace anthrob
