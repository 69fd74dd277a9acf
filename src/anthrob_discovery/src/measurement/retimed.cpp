#include "measurement/retimed.h"

#include <algorithm>

namespace anthrob {
namespace discovery {

void retime(Dataset& recording, const std::string& table, const std::vector<std::string>& columns,
            const std::string& name, const TimesTaken& times) {
  const Nanoseconds begin = recording.begin(), end = recording.end();
  Table& from = recording.table(table);
  Table moved;
  moved.name = name;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!times[i] || *times[i] < begin || *times[i] > end) continue;
    rows.push_back(i);
    moved.t.push_back(*times[i]);
  }
  for (const std::string& column : columns) {
    const Column* old = from.find(column);
    Column own;
    own.name = column;
    for (const std::size_t i : rows) {
      own.values.push_back(old->values[i]);
      own.present.push_back(old->present[i]);
    }
    moved.columns.push_back(std::move(own));
  }
  const auto is_moved = [&](const Column& column) {
    return std::find(columns.begin(), columns.end(), column.name) != columns.end();
  };
  from.columns.erase(std::remove_if(from.columns.begin(), from.columns.end(), is_moved),
                     from.columns.end());
  if (from.columns.empty()) {
    moved.name = table;
    from = std::move(moved);
  } else {
    recording.tables.push_back(std::move(moved));
  }
}

}  // namespace discovery
}  // namespace anthrob
