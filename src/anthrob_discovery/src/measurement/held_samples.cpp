#include "measurement/held_samples.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace anthrob {
namespace discovery {

namespace {

/// Rows in which everything was measured and something is fresh.
std::vector<std::size_t> fresh_rows(const Table& table, const std::vector<std::string>& columns) {
  std::vector<const Column*> own;
  for (const std::string& name : columns) own.push_back(table.find(name));
  std::vector<std::size_t> fresh;
  std::optional<std::size_t> before;
  for (std::size_t i = 0; i < table.t.size(); ++i) {
    if (!std::all_of(own.begin(), own.end(), [&](const Column* c) { return c->present[i] != 0; })) {
      continue;
    }
    // What the first row holds may be old.
    if (before && std::any_of(own.begin(), own.end(), [&](const Column* c) {
          return c->values[i] != c->values[*before];
        })) {
      fresh.push_back(i);
    }
    before = i;
  }
  return fresh;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Frames by number, and the times at which they appeared [s].
struct Frames {
  std::vector<double> number, time;

  /// Lowest and highest offset of a frame from a clock of this period, without the share that may
  /// be off it.
  std::pair<double, double> offsets(double period, double on_time) const {
    std::vector<double> late(time.size());
    for (std::size_t i = 0; i < late.size(); ++i) late[i] = time[i] - period * number[i];
    std::sort(late.begin(), late.end());
    const auto skipped =
        static_cast<std::size_t>(0.5 * (1.0 - on_time) * static_cast<double>(late.size()));
    return {late[skipped], late[late.size() - 1 - skipped]};
  }

  /// Counts frames by a clock of this period from one to the next.
  void count(double period) {
    number.assign(1, 0.0);
    for (std::size_t i = 1; i < time.size(); ++i) {
      number.push_back(number.back() + std::max(1.0, std::round((time[i] - time[i - 1]) / period)));
    }
  }

  /// By least squares.
  double slope() const {
    const double n = static_cast<double>(time.size());
    const double mean_number = std::accumulate(number.begin(), number.end(), 0.0) / n,
                 mean_time = std::accumulate(time.begin(), time.end(), 0.0) / n;
    double cross = 0.0, square = 0.0;
    for (std::size_t i = 0; i < time.size(); ++i) {
      cross += (number[i] - mean_number) * (time[i] - mean_time);
      square += (number[i] - mean_number) * (number[i] - mean_number);
    }
    return cross / square;
  }
};

/// The period near `first` for which offsets spread least; the spread is convex in it.
double tightest_period(const Frames& frames, double first, double reach, double on_time) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  const auto spread = [&](double period) {
    const auto [low, high] = frames.offsets(period, on_time);
    return high - low;
  };
  double low = first - reach, high = first + reach;
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double at_a = spread(a), at_b = spread(b);
  for (int i = 0; i < 40; ++i) {
    if (at_a <= at_b) {
      high = b, b = a, at_b = at_a;
      at_a = spread(a = high - golden * (high - low));
    } else {
      low = a, a = b, at_a = at_b;
      at_b = spread(b = low + golden * (high - low));
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

std::optional<HeldSamples> find_held(const Table& table, const std::vector<std::string>& columns,
                                     const HeldSampleOptions& options) {
  const std::vector<std::size_t> fresh = fresh_rows(table, columns);
  if (fresh.size() < options.fewest_frames) return {};
  std::vector<double> row_periods, distances;
  for (std::size_t i = 1; i < table.t.size(); ++i) {
    row_periods.push_back(seconds(table.t[i] - table.t[i - 1]));
  }
  Frames frames;
  for (const std::size_t i : fresh) {
    frames.time.push_back(seconds(table.t[i] - table.t.front()));
    if (frames.time.size() > 1) {
      distances.push_back(frames.time.back() - frames.time[frames.time.size() - 2]);
    }
  }
  HeldSamples held;
  held.row_period = median(row_periods);
  const double usual = median(distances);
  double sum = 0.0, count = 0.0;
  for (const double distance : distances) {
    if (distance <= options.neighbours * usual + 1e-9) sum += distance, count += 1.0;
  }
  if (count < 0.5 * static_cast<double>(options.fewest_frames)) return {};
  held.period = sum / count;
  if (held.period < options.least_rows * held.row_period) return {};

  // Long rests are counted right once the period is known well.
  for (int round = 0; round < 3; ++round) {
    frames.count(held.period);
    held.period = frames.slope();
  }
  if (held.period < options.least_rows * held.row_period) return {};
  held.uncertainty = held.row_period / frames.number.back();
  const double on_time = options.on_time.value;
  held.period = tightest_period(frames, held.period, 2.0 * held.uncertainty, on_time);
  const auto [low, high] = frames.offsets(held.period, on_time);
  if (high - low > (1.0 + options.slack.value) * held.row_period) return {};

  held.taken.resize(table.t.size());
  Nanoseconds last = table.t.front() - 1;
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    const double clock = low + held.period * frames.number[i];
    const double taken = std::clamp(clock, frames.time[i] - held.row_period, frames.time[i]);
    last =
        std::max(last + 1, table.t.front() + static_cast<Nanoseconds>(std::llround(1e9 * taken)));
    held.taken[fresh[i]] = last;
  }
  return held;
}

}  // namespace discovery
}  // namespace anthrob
