#include "dataset/sources.h"

#include <algorithm>
#include <cmath>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"

namespace anthrob {

namespace {

/// A jump that is no noise of a sensor, and one that is no position any more, in rad or m.
constexpr double kJump = 0.02, kNoPosition = 1e3;
/// Of a jump: what may be left of it a row later.
constexpr double kRemains = 0.2;
/// Of all rows: a sensor that errs now and then is not a second publisher.
constexpr double kOften = 0.05;
constexpr std::size_t kFewest = 5;

std::string who(const Dataset& dataset, const Table& table, const Column& column) {
  return dataset.folder + "/" + table.name + ".csv: column '" + column.name + "': ";
}

/// Rows that hold a value.
std::vector<std::size_t> rows_of(const Column& column) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < column.values.size(); ++i) {
    if (column.present[i]) rows.push_back(i);
  }
  return rows;
}

void refuse_two_values_at_once(const Dataset& dataset, const Table& table, const Column& column,
                               const std::vector<std::size_t>& rows) {
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const std::size_t before = rows[k - 1], row = rows[k];
    const double one = column.values[before], other = column.values[row];
    if (table.t[row] != table.t[before] || one == other || std::isnan(one) || std::isnan(other))
      continue;
    throw BadInput(who(dataset, table, column) + short_number(one) + " and " + short_number(other) +
                   " at one time, " + time_text(table.t[row]) +
                   " s: do two nodes publish it, or does a clock stand still? Expected one "
                   "publisher of each measurement, and time to grow");
  }
}

void refuse_jumps(const Dataset& dataset, const Table& table, const Column& column,
                  const std::vector<std::size_t>& rows) {
  std::size_t back = 0, first = 0;
  for (std::size_t k = 1; k + 1 < rows.size(); ++k) {
    const double before = column.values[rows[k - 1]], here = column.values[rows[k]],
                 after = column.values[rows[k + 1]];
    const double jump = std::min(std::abs(here - before), std::abs(after - here));
    if (!(jump > kJump) || !(jump < kNoPosition) || !(std::abs(after - before) < kRemains * jump))
      continue;
    if (back++ == 0) first = k;
  }
  if (back < kFewest || static_cast<double>(back) < kOften * static_cast<double>(rows.size()))
    return;
  throw BadInput(who(dataset, table, column) + "jumps to another value and back in " +
                 std::to_string(back) + " of " + std::to_string(rows.size()) +
                 " rows, first from " + short_number(column.values[rows[first - 1]]) + " to " +
                 short_number(column.values[rows[first]]) + " at " +
                 time_text(table.t[rows[first]]) +
                 " s: do two nodes publish it? Expected one publisher of each measurement");
}

}  // namespace

void check_sources(const Dataset& dataset) {
  for (const Table& table : dataset.tables) {
    if (table.name == "commands") continue;
    for (const Column& column : table.columns) {
      const std::vector<std::size_t> rows = rows_of(column);
      refuse_two_values_at_once(dataset, table, column, rows);
      if (table.name == "joints" && column.quantity() == "position")
        refuse_jumps(dataset, table, column, rows);
    }
  }
}

}  // namespace anthrob
