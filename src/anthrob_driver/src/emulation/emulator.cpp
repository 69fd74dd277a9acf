#include "anthrob_driver/emulation/emulator.h"

#include <ctime>

#include "anthrob_core/errors.h"
#include "anthrob_core/monotonic_clock.h"
#include "anthrob_driver/realtime.h"

namespace anthrob {
namespace driver {

namespace {

/// Frames wait in the socket meanwhile: they would be answered at the next tick anyway.
void sleep_until(double time) {
  timespec wake;
  wake.tv_sec = static_cast<std::time_t>(time);
  wake.tv_nsec = static_cast<long>(1e9 * (time - static_cast<double>(wake.tv_sec)));
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr);
}

}  // namespace

void refuse_physical_bus(const std::string& interface, bool physical) {
  if (physical || interface.rfind("vcan", 0) == 0) return;
  throw BadInput(
      "--can: " + interface +
      ": expected vcan0 or the like: emulated ECUs would disturb a robot on this bus and "
      "clear its emergency stop; if no robot is connected, add --physical");
}

void Emulator::run(const std::function<bool()>& quit, const std::function<void()>& each_tick) {
  const double too_late = 5.0 * period_;
  double deadline = monotonic_now();
  for (std::uint64_t ticks = 0; !quit(); ++ticks) {
    deadline += period_;
    sleep_until(deadline);
    const double now = monotonic_now();
    if (now - deadline > too_late) {
      deadline = now;
      ++late_;
    }
    // What waits was sent before this tick.
    rack_.receive();
    rack_.tick();
    if (ticks % 100 == 0) bus_.recover();
    each_tick();
  }
}

}  // namespace driver
}  // namespace anthrob
