#include "anthrob_recording/unanswered.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "anthrob_recording/quantities.h"

namespace anthrob {

namespace {

using Rows = std::vector<char>;  ///< of a table, whether each of them is meant

/// What sensors tell, and not what a unit or its commander says.
bool is_measured(const Column& column) {
  static const std::set<std::string> kMeasured = {
      "position", "velocity", "current", "voltage", "force", "w", "x", "y", "z", "wx", "wy", "wz"};
  return kMeasured.count(column.quantity()) > 0;
}

/// Empties losses that are short.
/// @return the rows that were emptied
Rows empty_losses(const Table& table, Column& column) {
  Rows emptied(table.t.size(), 0);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < table.t.size(); ++i) {
    if (column.present[i]) rows.push_back(i);
  }
  const auto is_lost = [&](std::size_t k) { return std::isnan(column.values[rows[k]]); };
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (!is_lost(k)) continue;
    const std::size_t first = k;
    while (k < rows.size() && is_lost(k)) ++k;
    const Nanoseconds since = table.t[rows[first > 0 ? first - 1 : 0]],
                      until = table.t[rows[std::min(k, rows.size() - 1)]];
    if (seconds(until - since) > kLongestLoss + 1e-9) continue;
    for (std::size_t i = first; i < k; ++i) {
      column.present[rows[i]] = 0;
      emptied[rows[i]] = 1;
    }
  }
  return emptied;
}

void empty_if_there_is_none(Column& column) {
  for (std::size_t i = 0; i < column.values.size(); ++i) {
    if (column.present[i] && !std::isnan(column.values[i])) return;
  }
  std::fill(column.present.begin(), column.present.end(), 0);
}

/// Where all that a unit measures was lost, it did not answer; one that tells of a fault, then or
/// when it answers again, tells more.
void empty_words(Table& table, const std::string& muscle, const Rows& lost) {
  std::vector<Column*> measured, words;
  for (Column& column : table.columns) {
    if (column.owner() == muscle) (is_measured(column) ? measured : words).push_back(&column);
  }
  const Column& state = *table.find(muscle + "/ecu_state");
  const double kFault = number_of("ecu_state", "FAULT").value();
  bool fault_next = false;
  for (std::size_t i = table.t.size(); i-- > 0;) {
    if (!state.present[i]) continue;
    const bool any = std::any_of(measured.begin(), measured.end(),
                                 [&](const Column* column) { return column->present[i] != 0; });
    const bool fault = state.values[i] == kFault;
    if (!lost[i] || any || !fault) {
      fault_next = fault;
    } else if (!fault_next) {
      for (Column* column : words) column->present[i] = 0;
    }
  }
}

}  // namespace

void leave_out_unanswered(Dataset& recording) {
  for (Table& table : recording.tables) {
    std::map<std::string, Rows> lost;
    for (Column& column : table.columns) {
      if (column.quantity() == "force") empty_if_there_is_none(column);
      if (is_measured(column)) lost[column.name] = empty_losses(table, column);
    }
    for (const Column& column : table.columns) {
      if (column.quantity() != "ecu_state") continue;
      const auto position = lost.find(column.owner() + "/position");
      if (position != lost.end()) empty_words(table, column.owner(), position->second);
    }
  }
}

}  // namespace anthrob
