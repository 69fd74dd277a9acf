#include "scope/series_difference.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace {

/// @param after the first sample of the series that is not before t
std::optional<double> between(SampleSpan samples, const Sample* after, Nanoseconds t) {
  if (after == samples.end()) return std::nullopt;
  double value = after->value;
  if (after->t != t) {
    if (after == samples.begin()) return std::nullopt;
    const Sample* before = after - 1;
    const double share =
        static_cast<double>(t - before->t) / static_cast<double>(after->t - before->t);
    value = before->value + share * (after->value - before->value);
  }
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

std::optional<double> value_at(SampleSpan samples, Nanoseconds t) {
  return between(samples, samples.at_or_after(t), t);
}

std::optional<SeriesDifference> difference_between(SampleSpan first, SampleSpan second,
                                                   Nanoseconds later) {
  SeriesDifference result;
  double sum = 0.0;
  const Sample* after = second.begin();
  for (const Sample& sample : first) {
    const Nanoseconds t = sample.t - later;
    while (after != second.end() && after->t < t) ++after;
    const auto other = between(second, after, t);
    if (!other || !std::isfinite(sample.value)) continue;
    const double difference = *other - sample.value;
    result.difference.push_back({sample.t, difference});
    sum += difference * difference;
    result.largest = std::max(result.largest, std::abs(difference));
  }
  if (result.difference.empty()) return std::nullopt;
  result.rms = std::sqrt(sum / static_cast<double>(result.difference.size()));
  return result;
}

}  // namespace anthrob
