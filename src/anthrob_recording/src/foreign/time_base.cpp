#include "foreign/time_base.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "anthrob_core/errors.h"
#include "anthrob_recording/dataset.h"
#include "anthrob_recording/orientation_series.h"
#include "anthrob_recording/quantities.h"

namespace anthrob {
namespace {

constexpr double kMostRows = 1e8;  ///< 28 h at 1 kHz; what memory holds

/// Rows of one rate [s] since the first sample.
struct TimeBase {
  double step = 0.0;
  std::size_t rows = 0;
  double at(std::size_t row) const { return step * static_cast<double>(row); }
};

using Cell = std::optional<double>;

/// The first sample that is not before `time`; times of rows and samples count as equal within a
/// nanosecond, the last digit of both.
std::size_t first_from(const std::vector<double>& t, double time) {
  return static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), time - 0.5e-9) - t.begin());
}

/// At `time`, on the straight line that fits samples `first` to before `end` best.
double on_line(const Series& s, std::size_t first, std::size_t end, double time) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = first; i < end; ++i) {
    const double dx = s.t[i] - time, dy = s.values[i] - s.values[first];
    n += 1.0, x += dx, y += dy, xx += dx * dx, xy += dx * dy;
  }
  return s.values[first] + (y * xx - x * xy) / (n * xx - x * x);
}

/// Whether a sample lies within half a row, and the row not before the first or after the last.
bool is_fresh(const std::vector<double>& t, double time, double step) {
  if (t.empty() || time < t.front() - 0.5e-9 || time > t.back() + 0.5e-9) return false;
  const std::size_t first = first_from(t, time - 0.5 * step);
  return first < first_from(t, time + 0.5 * step);
}

Cell measured_at(const Series& s, double time, double step) {
  if (!is_fresh(s.t, time, step)) return std::nullopt;
  const std::size_t at = first_from(s.t, time);
  const std::size_t first = first_from(s.t, time - 0.5 * step);
  const std::size_t end = first_from(s.t, time + 0.5 * step);
  if (end - first < 3 && at < end && s.t[at] < time + 0.5e-9) return s.values[at];
  return end - first > 2 ? on_line(s, first, end, time) : s.at(time);
}

/// Mean of what acts from `time` to the next row.
Cell mean_from(const Series& s, double time, double step) {
  if (s.empty() || time + step <= s.t.front() + 1e-9) return std::nullopt;
  double sum = 0.0, from = std::max(time, s.t.front());
  const double whole = time + step - from;
  std::size_t next = first_from(s.t, from + 1e-9);
  for (; next < s.t.size() && s.t[next] < time + step - 0.5e-9; ++next) {
    sum += (s.t[next] - from) * s.values[next - 1];
    from = s.t[next];
  }
  return (sum + (time + step - from) * s.values[next - 1]) / whole;
}

Cell set_before(const Series& s, double time, double step) {
  const std::size_t end = first_from(s.t, time + 1e-9);
  if (end == 0 || s.t[end - 1] <= time - step + 0.5e-9) return std::nullopt;
  return s.values[end - 1];
}

Cell cell_of(const std::string& quantity, const Series& s, double time, double step) {
  if (quantity == "reference" || holds_words(quantity)) return set_before(s, time, step);
  if (quantity == "voltage" || quantity == "effort" || quantity == "load") {
    return mean_from(s, time, step);
  }
  return measured_at(s, time, step);
}

bool is_of_an_orientation(const std::string& quantity) {
  return quantity == "w" || quantity == "x" || quantity == "y" || quantity == "z";
}

void put_orientation(const Dataset& streams, const std::string& joint, const TimeBase& base,
                     Table& table) {
  const OrientationSeries turns = OrientationSeries::read(streams, joint);
  const char* const parts[] = {"/w", "/x", "/y", "/z"};
  for (std::size_t row = 0; row < base.rows; ++row) {
    if (!is_fresh(turns.t(), base.at(row), base.step)) continue;
    double turn[4];
    turns.at(base.at(row), turn);
    for (int k = 0; k < 4; ++k) {
      Column& column = table.column(joint + parts[k]);
      column.values[row] = turn[k];
      column.present[row] = 1;
    }
  }
}

}  // namespace

std::vector<Table> on_time_base(const std::vector<Table>& tables, double rate) {
  Dataset streams, out;
  streams.tables = tables;
  TimeBase base;
  base.step = 1.0 / rate;
  const double length = seconds(streams.end() - streams.begin());
  if (length * rate > kMostRows) {
    throw BadInput("rows: " + exact_text(rate) + " Hz over " + exact_text(length) +
                   " s: expected at most 1e8 rows");
  }
  base.rows = static_cast<std::size_t>(std::ceil(length * rate - 1e-9)) + 1;
  std::vector<Nanoseconds> t;
  for (std::size_t row = 0; row < base.rows; ++row) {
    t.push_back(streams.begin() + std::llround(1e9 * base.at(row)));
  }
  for (const Table& table : tables) {
    Table& target = out.table(table.name);
    target.t = t;
    for (const Column& column : table.columns) {
      const std::string quantity = column.quantity();
      target.column(column.name);
      if (is_of_an_orientation(quantity)) {
        if (quantity == "z") put_orientation(streams, column.owner(), base, target);
        continue;
      }
      const Series series = streams.series(column.name);
      for (std::size_t row = 0; row < base.rows; ++row) {
        const Cell cell = cell_of(quantity, series, base.at(row), base.step);
        Column& made = target.column(column.name);
        made.present[row] = cell.has_value();
        made.values[row] = cell.value_or(0.0);
      }
    }
  }
  return out.tables;
}

}  // namespace anthrob
