#include "anthrob_driver/emulation/emulator.h"

#include <poll.h>

#include <ctime>

#include "anthrob_driver/driver_thread.h"

namespace anthrob {
namespace driver {

void Emulator::wait_for_frames(double until) {
  for (double left = until - monotonic_now(); left > 0.0; left = until - monotonic_now()) {
    timespec timeout{0, static_cast<long>(1e9 * left)};
    pollfd socket{bus_.descriptor(), POLLIN, 0};
    if (ppoll(&socket, 1, &timeout, nullptr) > 0) rack_.receive();
  }
}

void Emulator::run(const std::function<bool()>& quit, const std::function<void()>& each_tick) {
  const double too_late = 5.0 * period_;
  double deadline = monotonic_now();
  for (std::uint64_t ticks = 0; !quit(); ++ticks) {
    deadline += period_;
    wait_for_frames(deadline);
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
