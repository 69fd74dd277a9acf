#pragma once

#include <chrono>

namespace anthrob {

/// [s] of a clock that never jumps, whatever happens to the time of day; its beginning means
/// nothing.
inline double monotonic_now() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

}  // namespace anthrob
