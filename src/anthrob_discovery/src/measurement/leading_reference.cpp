#include "measurement/leading_reference.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "anthrob_ecu/control_law.h"

namespace anthrob {
namespace discovery {

namespace {

/// Adds rows without values, each before one of the old ones.
void insert_empty_rows(Table& table, const std::vector<std::size_t>& before,
                       const std::vector<Nanoseconds>& times) {
  const auto insert = [&](auto& values, const auto& added) {
    if (values.empty()) return;
    for (std::size_t i = before.size(); i-- > 0;) {
      values.insert(values.begin() + static_cast<std::ptrdiff_t>(before[i]), added[i]);
    }
  };
  insert(table.t, times);
  insert(table.stamp, times);
  insert(table.bag_time, times);
  for (Column& column : table.columns) {
    insert(column.values, std::vector<double>(before.size(), 0.0));
    insert(column.present, std::vector<char>(before.size(), 0));
  }
}

/// Places a reference one tick after each that is followed later than that.
void hold_for_a_tick(Table& table, const std::string& name, Nanoseconds tick) {
  const Column& reference = *table.find(name);
  std::vector<std::size_t> before;
  std::vector<Nanoseconds> times;
  std::vector<double> held;
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < table.t.size(); ++i) {
    if (!reference.present[i]) continue;
    if (last && table.t[i] - table.t[*last] > tick + tick / 2) {
      const Nanoseconds time = table.t[*last] + tick;
      const auto row = std::upper_bound(table.t.begin(), table.t.end(), time);
      before.push_back(static_cast<std::size_t>(row - table.t.begin()));
      times.push_back(time);
      held.push_back(reference.values[*last]);
    }
    last = i;
  }
  insert_empty_rows(table, before, times);
  Column& longer = table.column(name);
  for (std::size_t i = 0; i < before.size(); ++i) {
    longer.values[before[i] + i] = held[i], longer.present[before[i] + i] = 1;
  }
}

}  // namespace

void lead_reference(const std::string& muscle, double lead, double tick, Dataset& recording) {
  const std::string name = muscle + "/reference";
  for (Table& table : recording.tables) {
    if (!table.find(name)) continue;
    hold_for_a_tick(table, name, static_cast<Nanoseconds>(std::llround(1e9 * tick)));
    const Column* mode = table.find(muscle + "/mode");
    const auto asks_for_position = [&](std::size_t row, bool before) {
      if (!mode || !mode->present[row]) return before;
      return mode->values[row] == static_cast<double>(ecu::Mode::kPosition);
    };
    Column& reference = table.column(name);
    std::optional<double> last;  // position that was asked for
    bool is_position = true;
    for (std::size_t i = 0; i < table.t.size(); ++i) {
      is_position = asks_for_position(i, is_position);
      if (!is_position) last.reset();
      if (!is_position || !reference.present[i]) continue;
      const double asked = reference.values[i];
      if (last) reference.values[i] += lead * (asked - *last) / tick;
      last = asked;
    }
  }
}

}  // namespace discovery
}  // namespace anthrob
