#include "foreign/pieces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "anthrob_core/errors.h"
#include "anthrob_recording/quantities.h"

namespace anthrob {
namespace {

/// What a row sets until the next one does.
bool holds_on(const std::string& quantity) {
  for (const char* word : {"reference", "mode", "voltage", "effort", "load"}) {
    if (quantity == word) return true;
  }
  return is_push_quantity(quantity);
}

constexpr Nanoseconds kAtFirst = 100000000;  ///< as Series::acting_at()

/// Gives the beginning of a part what held before it. @param first row of the part's first in
/// `whole`
void carry_over(const Table& whole, std::size_t first, Nanoseconds begin, Table& part) {
  const bool late = part.t.empty() || part.t.front() - begin > kAtFirst;
  std::vector<std::pair<std::size_t, double>> carried;
  for (std::size_t c = 0; c < whole.columns.size() && first > 0; ++c) {
    const Column& column = whole.columns[c];
    const bool push = is_push_quantity(column.quantity());
    if (!holds_on(column.quantity()) || (!late && (push || part.columns[c].present[0]))) continue;
    // A push ends at the first row without its cells.
    std::size_t last = first - 1;
    while (!push && last > 0 && !column.present[last]) --last;
    if (column.present[last]) carried.emplace_back(c, column.values[last]);
  }
  if (carried.empty()) return;
  if (late) {
    part.t.insert(part.t.begin(), begin);
    for (Column& column : part.columns) {
      column.values.insert(column.values.begin(), 0.0);
      column.present.insert(column.present.begin(), 0);
    }
  }
  for (const auto& [c, value] : carried) {
    part.columns[c].values[0] = value;
    part.columns[c].present[0] = 1;
  }
}

}  // namespace

Dataset cut(const Dataset& whole, const Piece& piece) {
  const Nanoseconds begin = whole.begin() + std::llround(1e9 * piece.from);
  const Nanoseconds end = whole.begin() + std::llround(1e9 * piece.to);
  Dataset part;
  part.folder = whole.folder;
  part.meta = whole.meta;
  std::size_t rows = 0;
  for (const Table& table : whole.tables) {
    const auto at = [&](Nanoseconds t) {
      return std::lower_bound(table.t.begin(), table.t.end(), t) - table.t.begin();
    };
    const std::ptrdiff_t first = at(begin), last = at(end);
    Table cut;
    cut.name = table.name;
    cut.t.assign(table.t.begin() + first, table.t.begin() + last);
    for (const Column& column : table.columns) {
      cut.columns.push_back({column.name,
                             {column.values.begin() + first, column.values.begin() + last},
                             {column.present.begin() + first, column.present.begin() + last}});
    }
    rows = std::max(rows, cut.t.size());
    carry_over(table, static_cast<std::size_t>(first), begin, cut);
    if (!cut.t.empty()) part.tables.push_back(std::move(cut));
  }
  if (rows < 2) {
    throw BadInput(whole.folder + ": split: " + piece.name + ": fewer than two rows from " +
                   exact_text(piece.from) + " to " + exact_text(piece.to) +
                   " s; expected times since the first row, up to " +
                   time_text(whole.end() - whole.begin()) + " s");
  }
  return part;
}

}  // namespace anthrob
