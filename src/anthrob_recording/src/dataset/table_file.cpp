#include "dataset/table_file.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <set>
#include <system_error>
#include <vector>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "anthrob_recording/quantities.h"

namespace anthrob {

namespace {

/// "VOLTAGE, POSITION, ..."
std::string words_of(const std::string& quantity) {
  std::string text;
  for (int i = 0; word_of(quantity, i) != std::to_string(i); ++i) {
    text += (i == 0 ? "" : ", ") + word_of(quantity, i);
  }
  return text;
}

/// Splits a line at commas; no quoting: no name or number of a recording contains a comma.
std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t comma = line.find(',', begin);
    cells.push_back(line.substr(begin, comma == std::string::npos ? comma : comma - begin));
    if (comma == std::string::npos) return cells;
    begin = comma + 1;
  }
}

/// Exact for plain decimals with up to nine places; others are rounded to a nanosecond.
bool parse_time(const std::string& cell, Nanoseconds& t) {
  const char* end = cell.data() + cell.size();
  double value = 0.0;
  const auto number = std::from_chars(cell.data(), end, value);
  if (number.ec != std::errc() || number.ptr != end || !std::isfinite(value)) return false;
  if (std::abs(value) > 9e9) return false;
  const std::size_t point = cell.find('.');
  const std::string whole = cell.substr(0, point);
  const std::string decimals = point == std::string::npos ? "" : cell.substr(point + 1);
  const bool plain = cell.find_first_of("eE") == std::string::npos && decimals.size() <= 9;
  if (!plain) {
    t = static_cast<Nanoseconds>(std::llround(value * 1e9));
    return true;
  }
  const std::string digits = whole + decimals + std::string(9 - decimals.size(), '0');
  const auto exact = std::from_chars(digits.data(), digits.data() + digits.size(), t);
  return exact.ec == std::errc() && exact.ptr == digits.data() + digits.size();
}

class TableReader {
 public:
  explicit TableReader(const std::filesystem::path& file) : file_(file.string()), in_(file) {
    table_.name = file.stem().string();
  }

  Table read() {
    read_header();
    std::string line;
    for (row_ = 2; std::getline(in_, line); ++row_) {
      if (!trimmed(line).empty()) read_row(split(line));
    }
    if (in_.bad()) throw BadInput(file_ + ": reading stopped: input error");
    return std::move(table_);
  }

  /// @throws BadInput if the file is no table
  void read_header() {
    if (!in_) throw BadInput(file_ + ": cannot be read");
    std::string line;
    const bool any = static_cast<bool>(std::getline(in_, line));
    constexpr const char* kByteOrderMark = "\xef\xbb\xbf";  // of spreadsheet programs
    if (line.rfind(kByteOrderMark, 0) == 0) line.erase(0, 3);
    if (!any || trimmed(line).empty()) {
      throw BadInput(file_ + ": empty; expected a header line 't,<name>/<quantity>,...'");
    }
    const auto names = split(line);
    if (trimmed(names[0]) != "t")
      fail(trimmed(names[0]) + ": expected the first column to be 't' [s]");
    std::set<std::string> seen;
    for (std::size_t i = 1; i < names.size(); ++i) {
      Column column;
      column.name = trimmed(names[i]);
      if (!bookkeeping(column.name) &&
          (column.name.find('/') == std::string::npos || !is_known_quantity(column.quantity()))) {
        fail("column '" + column.name +
             "': expected <muscle>/mode, reference, position, velocity, current, voltage, force or "
             "ecu_state, <ball_joint>/w, x, y, z, wx, wy or wz, or <joint>/position, velocity, "
             "effort or load");
      }
      if (!seen.insert(column.name).second) fail("column '" + column.name + "' appears twice");
      header_.push_back(column.name);
      if (!bookkeeping(column.name)) table_.columns.push_back(column);
    }
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw BadInput(file_ + ":" + std::to_string(row_) + ": " + message);
  }

  void read_row(const std::vector<std::string>& cells) {
    if (cells.size() != header_.size() + 1) {
      fail(std::to_string(cells.size()) + " cells: expected " + std::to_string(header_.size() + 1) +
           ", as many as the header has");
    }
    const Nanoseconds t = read_time("t", trimmed(cells[0]));
    if (!table_.t.empty() && t < table_.t.back()) {
      fail("t: " + trimmed(cells[0]) + ": earlier than the previous row; expected time to grow");
    }
    table_.t.push_back(t);
    std::size_t next = 0;
    for (std::size_t i = 0; i < header_.size(); ++i) {
      const std::string cell = trimmed(cells[i + 1]);
      if (header_[i] == "stamp") {
        table_.stamp.push_back(read_time("stamp", cell));
      } else if (header_[i] == "bag_time") {
        table_.bag_time.push_back(read_time("bag_time", cell));
      } else {
        read_cell(cell, table_.columns[next++]);
      }
    }
  }

  static bool bookkeeping(const std::string& name) { return name == "stamp" || name == "bag_time"; }

  Nanoseconds read_time(const std::string& name, const std::string& cell) const {
    Nanoseconds t = 0;
    if (!parse_time(cell, t)) fail(name + ": '" + cell + "': expected a time [s]");
    return t;
  }

  void read_cell(const std::string& cell, Column& column) {
    double value = 0.0;
    if (!cell.empty() && holds_words(column.quantity())) {
      const std::optional<int> number = number_of(column.quantity(), cell);
      if (!number)
        fail(column.name + ": '" + cell + "': expected one of " + words_of(column.quantity()));
      value = *number;
    } else if (!cell.empty()) {
      const char* end = cell.data() + cell.size();
      const auto result = std::from_chars(cell.data(), end, value);
      if (result.ec != std::errc() || result.ptr != end) {
        fail(column.name + ": '" + cell + "': expected a number");
      }
    }
    column.values.push_back(value);
    column.present.push_back(!cell.empty());
  }

  std::string file_;
  std::ifstream in_;
  Table table_;
  std::vector<std::string> header_;
  int row_ = 1;
};

}  // namespace

Table read_table(const std::filesystem::path& file) {
  return TableReader(file).read();
}

void require_table_header(const std::filesystem::path& file) {
  TableReader(file).read_header();
}

std::string table_text(const Table& table) {
  std::string out = "t";
  if (!table.stamp.empty()) out += ",stamp";
  if (!table.bag_time.empty()) out += ",bag_time";
  for (const Column& column : table.columns) out += "," + column.name;
  out += "\n";
  for (std::size_t i = 0; i < table.t.size(); ++i) {
    out += time_text(table.t[i]);
    if (!table.stamp.empty()) out += "," + time_text(table.stamp[i]);
    if (!table.bag_time.empty()) out += "," + time_text(table.bag_time[i]);
    for (const Column& column : table.columns) {
      out += ",";
      if (!column.present[i]) continue;
      if (holds_words(column.quantity())) {
        out += word_of(column.quantity(), static_cast<int>(column.values[i]));
      } else {
        out += exact_text(column.values[i]);
      }
    }
    out += "\n";
  }
  return out;
}

}  // namespace anthrob
