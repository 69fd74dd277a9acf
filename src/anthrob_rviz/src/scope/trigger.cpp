#include "scope/trigger.h"

#include <cmath>

namespace anthrob {
namespace {

bool crosses(double before, double after, const Trigger& trigger) {
  const bool rises = before < trigger.level && after >= trigger.level;
  const bool falls = before > trigger.level && after <= trigger.level;
  switch (trigger.edge) {
    case Trigger::Edge::kRising:
      return rises;
    case Trigger::Edge::kFalling:
      return falls;
    case Trigger::Edge::kEither:
      return rises || falls;
  }
  return false;
}

/// Between two finite values on different sides of the level, or the second one on it.
Nanoseconds instant_of(const Sample& before, const Sample& after, double level) {
  const double share = (level - before.value) / (after.value - before.value);
  return before.t + std::llround(share * static_cast<double>(after.t - before.t));
}

}  // namespace

std::optional<Sweep> last_sweep(SampleSpan samples, const Trigger& trigger) {
  const auto pre = std::llround(trigger.pre * static_cast<double>(trigger.width));
  for (std::size_t i = samples.size(); i-- > 1;) {
    const Sample& before = samples.begin()[i - 1];
    const Sample& after = samples.begin()[i];
    // Comparisons with NaN are false.
    if (!crosses(before.value, after.value, trigger)) continue;
    if (!std::isfinite(before.value) || !std::isfinite(after.value)) continue;
    const Nanoseconds crossing = instant_of(before, after, trigger.level);
    const Sweep sweep = {crossing - pre, crossing, crossing - pre + trigger.width};
    if (sweep.end <= samples.back().t) return sweep;
  }
  return std::nullopt;
}

}  // namespace anthrob
