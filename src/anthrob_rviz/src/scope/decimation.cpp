#include "scope/decimation.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace {

/// Appends the extremes of samples that share a column. @param first < last
void append_extremes(const Sample* first, const Sample* last, std::vector<Sample>& drawn) {
  const Sample* least = nullptr;
  const Sample* greatest = nullptr;
  for (const Sample* sample = first; sample != last; ++sample) {
    if (std::isnan(sample->value)) continue;
    if (least == nullptr || sample->value < least->value) least = sample;
    if (greatest == nullptr || sample->value > greatest->value) greatest = sample;
  }
  if (least == nullptr) {
    drawn.push_back(*first);
  } else if (least == greatest) {
    drawn.push_back(*least);
  } else {
    drawn.push_back(*std::min(least, greatest));
    drawn.push_back(*std::max(least, greatest));
  }
}

}  // namespace

std::vector<Sample> decimated(SampleSpan samples, Nanoseconds begin, Nanoseconds end, int columns) {
  if (samples.empty() || end <= begin || columns < 1) return {};
  const Sample* first = samples.at_or_after(begin);
  const Sample* last = samples.at_or_after(end);
  const Sample* before = first == samples.begin() ? first : first - 1;
  const Sample* after = last == samples.end() ? last : last + 1;
  if (last - first <= 2 * columns) return std::vector<Sample>(before, after);
  std::vector<Sample> drawn(before, first);
  drawn.reserve(2 * static_cast<std::size_t>(columns) + 2);
  const double width = static_cast<double>(end - begin) / columns;
  for (int column = 1; column <= columns && first != last; ++column) {
    const Nanoseconds limit =
        column == columns ? end : begin + static_cast<Nanoseconds>(width * column);
    const Sample* next = first;
    while (next != last && next->t < limit) ++next;
    if (next != first) append_extremes(first, next, drawn);
    first = next;
  }
  drawn.insert(drawn.end(), last, after);
  return drawn;
}

}  // namespace anthrob
