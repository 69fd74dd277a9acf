#include "anthrob_recording/table.h"

#include <charconv>

namespace anthrob {

const Column* Table::find(const std::string& column_name) const {
  for (const Column& c : columns) {
    if (c.name == column_name) return &c;
  }
  return nullptr;
}

Column& Table::column(const std::string& column_name) {
  for (Column& c : columns) {
    if (c.name == column_name) return c;
  }
  columns.push_back(
      {column_name, std::vector<double>(t.size(), 0.0), std::vector<char>(t.size(), 0)});
  return columns.back();
}

std::string exact_text(double value) {
  char text[40];
  const auto result = std::to_chars(text, text + sizeof(text), value);
  return std::string(text, result.ptr);
}

std::string time_text(Nanoseconds t) {
  const bool negative = t < 0;
  const std::uint64_t size =
      negative ? 0 - static_cast<std::uint64_t>(t) : static_cast<std::uint64_t>(t);
  std::string decimals = std::to_string(size % 1000000000u);
  decimals = std::string(9 - decimals.size(), '0') + decimals;
  while (decimals.size() > 3 && decimals.back() == '0') decimals.pop_back();
  return (negative ? "-" : "") + std::to_string(size / 1000000000u) + "." + decimals;
}

}  // namespace anthrob
