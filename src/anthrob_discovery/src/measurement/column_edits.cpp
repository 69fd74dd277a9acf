#include "measurement/column_edits.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "measurement/retimed.h"

namespace anthrob {
namespace discovery {

namespace {

template <typename Edit>
void for_each_column(Dataset& recording, const ColumnChoice& chosen, Edit edit) {
  for (Table& table : recording.tables) {
    if (table.name == "commands") continue;
    for (Column& column : table.columns) {
      if (chosen(column)) edit(table, column);
    }
  }
}

}  // namespace

void divide_columns(Dataset& recording, const ColumnChoice& chosen, double factor) {
  for_each_column(recording, chosen, [&](const Table&, Column& column) {
    for (double& value : column.values) value /= factor;
  });
}

void move_columns(Dataset& recording, const ColumnChoice& chosen, double late) {
  const auto shift = static_cast<Nanoseconds>(std::llround(1e9 * late));
  for (std::size_t k = 0, count = recording.tables.size(); k < count; ++k) {
    const Table& table = recording.tables[k];
    if (table.name == "commands") continue;
    std::vector<std::string> columns;
    for (const Column& column : table.columns) {
      if (chosen(column)) columns.push_back(column.name);
    }
    if (columns.empty()) continue;
    TimesTaken times;
    for (const Nanoseconds t : table.t) times.emplace_back(t - shift);
    retime(recording, std::string(table.name), columns,
           table.name + " of " + columns.front() + " and the like", times);
  }
}

void undo_filters(Dataset& recording, const ColumnChoice& chosen, double time_constant) {
  for_each_column(recording, chosen, [&](const Table& table, Column& column) {
    const std::vector<double> values = column.values;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t from = i > 0 ? i - 1 : 0, to = std::min(i + 1, values.size() - 1);
      const double span = seconds(table.t[to] - table.t[from]);
      if (span > 0.0) column.values[i] += time_constant * (values[to] - values[from]) / span;
    }
  });
}

void move_clock(Dataset& recording, const std::string& name, double late, double drift) {
  const Table& table = *recording.find_table(name);
  std::vector<std::string> columns;
  for (const Column& column : table.columns) columns.push_back(column.name);
  TimesTaken times;
  for (const Nanoseconds t : table.t) {
    const double since = static_cast<double>(t - recording.begin());
    times.emplace_back(t - static_cast<Nanoseconds>(std::llround(1e9 * late + drift * since)));
  }
  retime(recording, name, columns, name, times);
}

}  // namespace discovery
}  // namespace anthrob
