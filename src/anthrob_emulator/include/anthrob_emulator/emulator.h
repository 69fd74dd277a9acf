#pragma once

#include <atomic>
#include <functional>

#include "anthrob_driver/bus/socketcan_bus.h"
#include "anthrob_driver/emulation/rack.h"

namespace anthrob {

/// Runs a rack of emulated ECUs on a CAN interface in real time. When the machine is too slow,
/// its milliseconds get longer rather than fewer: the ECUs' watchdogs count their own ticks.
class Emulator {
 public:
  Emulator(driver::Rack& rack, driver::SocketCanBus& bus) : rack_(rack), bus_(bus) {}

  /// @param quit ends the loop   @param each_tick called after every millisecond
  void run(const std::function<bool()>& quit, const std::function<void()>& each_tick);
  /// Milliseconds that took longer.
  std::uint64_t late() const { return late_; }

 private:
  void wait_for_frames(double until);

  driver::Rack& rack_;
  driver::SocketCanBus& bus_;
  std::uint64_t late_ = 0;
};

}  // namespace anthrob
