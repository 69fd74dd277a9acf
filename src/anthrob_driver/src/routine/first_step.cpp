#include "routine/first_step.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace anthrob {
namespace driver {

std::optional<std::string> FirstStep::too_far(const std::vector<std::string>& names,
                                              const std::vector<std::uint8_t>& modes,
                                              const std::vector<double>& references,
                                              const std::vector<ecu::MuscleReference>& followed,
                                              const Sample& last) const {
  const std::size_t count = std::min({names.size(), modes.size(), references.size()});
  if (limit_ <= 0.0) return std::nullopt;
  if (count > hardware_.muscles.size()) return std::nullopt;  // malformed, however long it is
  for (std::size_t i = 0; i < count; ++i) {
    const bool position = static_cast<ecu::Mode>(modes[i]) == ecu::Mode::kPosition;
    if (!position || !std::isfinite(references[i])) continue;
    for (std::size_t m = 0; m < hardware_.muscles.size(); ++m) {
      if (hardware_.muscles[m].name != names[i]) continue;
      if (followed[m].mode == ecu::Mode::kPosition) continue;  // it follows already
      // NaN if there is no measurement just now; the comparison then forbids the command.
      const double step = std::abs(references[i] - last.muscles[m].position);
      if (step <= limit_) continue;
      char text[160];
      std::snprintf(text, sizeof(text),
                    "POSITION %.2f rad is %.2f rad from where the muscle is, more than first_step "
                    "(%.2f rad): begin near its present position",
                    references[i], step, limit_);
      return "muscle '" + names[i] + "': " + text;
    }
  }
  return std::nullopt;
}

}  // namespace driver
}  // namespace anthrob
