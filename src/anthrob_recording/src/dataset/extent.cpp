#include "anthrob_recording/extent.h"

namespace anthrob {

namespace {

std::string counted(std::size_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

}  // namespace

std::string extent_of(const Dataset& data) {
  std::size_t rows = 0;
  for (const Table& table : data.tables) rows += table.t.size();
  return counted(data.tables.size(), "table") + ", " + counted(rows, "row") + ", " +
         time_text(data.end() - data.begin()) + " s";
}

}  // namespace anthrob
