#include "virtual_rig/virtual_recording.h"

#include <cmath>

namespace anthrob {
namespace virtual_rig {

RowWriter::RowWriter(Table& table, const std::vector<std::string>& columns) : table_(table) {
  for (const std::string& name : columns) table_.column(name);
}

void RowWriter::add(double time, const std::vector<double>& values) {
  table_.t.push_back(static_cast<Nanoseconds>(std::llround(1e9 * time)));
  for (std::size_t i = 0; i < values.size(); ++i) {
    table_.columns[i].values.push_back(values[i]);
    table_.columns[i].present.push_back(1);
  }
}

}  // namespace virtual_rig
}  // namespace anthrob
