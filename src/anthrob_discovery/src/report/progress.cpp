#include "report/progress.h"

#include <cstdio>

namespace anthrob {
namespace discovery {

std::string progress_text(double elapsed, std::size_t simulated, const Batch& batch) {
  char text[120];
  int length = std::snprintf(text, sizeof(text), "%.0f s, %zu simulations", elapsed, simulated);
  // Shorter ones are not shown: some run side by side.
  if (batch.size >= 10 && batch.done > 0 && batch.done < batch.size) {
    const double left = batch.elapsed * static_cast<double>(batch.size - batch.done) /
                        static_cast<double>(batch.done);
    std::snprintf(text + length, sizeof(text) - static_cast<std::size_t>(length),
                  "; current batch: %zu of %zu, %.0f s left", batch.done, batch.size, left);
  }
  return text;
}

}  // namespace discovery
}  // namespace anthrob
