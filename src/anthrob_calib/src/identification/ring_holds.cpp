#include "identification/ring_holds.h"

#include <algorithm>
#include <cmath>

#include "identification/estimate.h"

namespace anthrob {
namespace identification {

namespace {

constexpr double kSteadyHold = 0.02;   ///< of the travel: a controller settles, an encoder counts
constexpr double kShortestHold = 0.5;  ///< [s]

/// First row that has left the range of those from `begin` on.
std::size_t end_of_steady(const std::vector<double>& position, std::size_t begin, double range) {
  double low = position[begin], high = low;
  std::size_t row = begin + 1;
  for (; row < position.size(); ++row) {
    low = std::min(low, position[row]);
    high = std::max(high, position[row]);
    if (high - low > range) break;
  }
  return row;
}

}  // namespace

std::vector<RingHold> find_holds(const std::vector<double>& t,
                                 const std::vector<double>& position) {
  std::vector<RingHold> holds;
  if (position.empty()) return holds;
  const auto [low, high] = std::minmax_element(position.begin(), position.end());
  const double range = kSteadyHold * (*high - *low);
  for (std::size_t begin = 0; begin < position.size();) {
    const std::size_t end = end_of_steady(position, begin, range);
    if (t[end - 1] - t[begin] < kShortestHold) {
      ++begin;
      continue;
    }
    const double mean = identification::mean(position, begin, end);
    const bool goes_on = !holds.empty() && holds.back().end == begin &&
                         std::abs(mean - holds.back().position) <= range;
    if (goes_on) {
      holds.back().end = end;  // it settles slowly
      holds.back().position = identification::mean(position, holds.back().begin, end);
    } else {
      holds.push_back({begin, end, mean, false});
    }
    begin = end;
  }
  for (RingHold& hold : holds) hold.released = hold.position - *low <= range;
  return holds;
}

}  // namespace identification
}  // namespace anthrob
