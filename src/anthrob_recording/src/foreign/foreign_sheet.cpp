#include "foreign/foreign_sheet.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"

namespace anthrob {
namespace {

constexpr double kLatest = 9e9;  ///< [s] nanoseconds of 64 bits end there
constexpr int kSearched = 100;   ///< lines in which names are looked for that the header lacks

constexpr char kBlank[] = " \t\r\"";  // quotes, too

/// Cells of a line; separators inside quotes belong to the cell.
std::vector<std::string> cells_of(const std::string& line, char separator) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == separator && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  for (std::string& cell : cells) cell = trimmed(cell, kBlank);
  return cells;
}

bool holds(const std::vector<std::string>& cells, const std::string& name) {
  return std::find(cells.begin(), cells.end(), name) != cells.end();
}

bool is_number(const std::string& word) {
  double value = 0.0;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  return result.ec == std::errc() && result.ptr == word.data() + word.size();
}

class SheetReader {
 public:
  SheetReader(const std::string& file, const ForeignFormat& format,
              const std::set<ForeignColumn>& wanted)
      : file_(file), format_(format), wanted_(wanted.begin(), wanted.end()), in_(file) {}

  ForeignSheet read() {
    if (!in_) throw BadInput(file_ + ": cannot be read");
    sheet_.file = file_;
    read_header();
    int blank = 0;  // the first line without anything, 0: none
    for (std::string line; std::getline(in_, line);) {
      ++row_;
      if (trimmed(line, kBlank).empty()) {
        if (blank == 0) blank = row_;
        continue;
      }
      // Time counts rows: is this one, in which nothing was measured, or none?
      if (blank > 0 && !format_.time) {
        row_ = blank;
        fail("an empty row; expected none, because `rate` counts rows");
      }
      refuse_open_quote(line);
      read_row(cells_of(line, format_.separator));
    }
    if (sheet_.stamp.size() < 2) {
      throw BadInput(file_ + ": fewer than two rows; expected a recording");
    }
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      sheet_.columns[wanted_[i]] = std::move(values_[i]);
    }
    return std::move(sheet_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw BadInput(file_ + ":" + std::to_string(row_) + ": " + message);
  }

  void read_header() {
    // Without names, the first row tells how many columns there are.
    const int naming = format_.header > 0 ? format_.header : format_.skip + 1;
    std::string line;
    while (row_ < naming && std::getline(in_, line)) {
      constexpr const char* kByteOrderMark = "\xef\xbb\xbf";
      if (++row_ == 1 && line.rfind(kByteOrderMark, 0) == 0) line.erase(0, 3);
      refuse_other_text(line);
    }
    if (row_ > 0 && row_ < naming) {
      throw BadInput(format_.map + ": header: " + std::to_string(format_.header) + ": " + file_ +
                     " has " + std::to_string(row_) + " lines; expected one that names columns");
    }
    row_ = std::max(row_, 1);
    refuse_open_quote(line);
    header_ = cells_of(line, format_.separator);
    if (format_.header == 0) {
      for (std::string& name : header_) name.clear();
      in_.clear();
      in_.seekg(0);
      row_ = 0;
    }
    if (format_.time) time_ = place_of(*format_.time);
    for (const ForeignColumn& column : wanted_) places_.push_back(place_of(column));
    values_.resize(places_.size());
    for (int i = 0; i < format_.skip && std::getline(in_, line); ++i) ++row_;
    first_row_ = row_ + 1;
  }

  /// What other programs write, but no table of lines.
  void refuse_other_text(const std::string& line) const {
    if (line.find('\0') != std::string::npos) {
      fail("not text in UTF-8; expected a table in UTF-8 (saved as UTF-16?)");
    }
    const std::size_t cr = line.find('\r');
    if (cr != std::string::npos && cr + 1 < line.size()) {
      fail("lines end with CR alone, as on old Macs; expected LF or CR LF");
    }
  }

  void refuse_open_quote(const std::string& line) const {
    if (std::count(line.begin(), line.end(), '"') % 2 == 0) return;
    fail("a quote that has no end in its line; expected every row, and every name, in one line");
  }

  std::size_t place_of(const ForeignColumn& column) const {
    if (column.place > 0) {
      if (static_cast<std::size_t>(column.place) <= header_.size()) {
        return static_cast<std::size_t>(column.place) - 1;
      }
      throw BadInput(format_.map + ": place " + std::to_string(column.place) + " is not in " +
                     file_ + "; expected at most " + std::to_string(header_.size()) +
                     ", as many columns as it has");
    }
    const std::string& name = column.name;
    if (format_.header == 0) {
      throw BadInput(format_.map + ": column '" + name + "': with header: 0 columns have no " +
                     "names; expected {place: 1} for the first");
    }
    const auto found = std::find(header_.begin(), header_.end(), name);
    if (found != header_.end()) {
      if (std::find(found + 1, header_.end(), name) != header_.end()) {
        throw BadInput(file_ + ": column '" + name + "' appears twice; expected it once, or " +
                       "{place: NUMBER} instead of its name");
      }
      return static_cast<std::size_t>(found - header_.begin());
    }
    throw BadInput(format_.map + ": column '" + name + "' is not in " + file_ + hint(name));
  }

  /// What may have been meant instead of a name that the header lacks.
  std::string hint(const std::string& name) const {
    if (is_number(name)) return "; for a number, write {constant: " + name + "}";
    std::ifstream again(file_);
    std::string line;
    for (int i = 1; i <= kSearched && std::getline(again, line); ++i) {
      if (i != format_.header && holds(cells_of(line, format_.separator), name)) {
        return ":" + std::to_string(format_.header) + ", but in line " + std::to_string(i) +
               "; expected header: " + std::to_string(i) + "?";
      }
    }
    const std::string there = joined(header_);
    if (there.empty()) return ", which is empty";
    const bool semicolons = header_.size() == 1 && there.find(';') != std::string::npos;
    return "; expected one of: " + there +
           (format_.separator != ';' && semicolons ? " (is separator: \";\" missing?)" : "");
  }

  double number(const std::vector<std::string>& cells, std::size_t place) const {
    std::string cell = cells[place];
    if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
    if (format_.decimal != '.') {
      if (cell.find('.') != std::string::npos) refuse_cell(cells, place);
      std::replace(cell.begin(), cell.end(), format_.decimal, '.');
    }
    double value = 0.0;
    const char* begin = cell.data() + (cell[0] == '+' ? 1 : 0);
    const char* end = cell.data() + cell.size();
    const auto result = std::from_chars(begin, end, value);
    if (result.ec != std::errc() || result.ptr != end || !std::isfinite(value)) {
      refuse_cell(cells, place);
    }
    return value;
  }

  [[noreturn]] void refuse_cell(const std::vector<std::string>& cells, std::size_t place) const {
    const std::string& cell = cells[place];
    const bool comma = format_.decimal == '.' && cell.find(',') != std::string::npos;
    std::string cause;
    if (comma)
      cause = "; is decimal: \",\" missing?";
    else if (row_ == first_row_ && !is_number(cell))
      cause = "; a row of units? set skip: 1";
    const std::string name =
        header_[place].empty() ? std::to_string(place + 1) : "'" + header_[place] + "'";
    fail("column " + name + ": '" + cell + "': expected a number" + cause);
  }

  Nanoseconds time(const std::vector<std::string>& cells) {
    double t = static_cast<double>(sheet_.stamp.size()) / format_.rate;
    if (format_.time) {
      t = format_.time_scale * number(cells, time_);
      if (!std::isfinite(t)) fail("column '" + header_[time_] + "': empty; expected a time");
    }
    t += format_.time_offset;
    if (std::abs(t) > kLatest) {
      std::ostringstream text;
      text << t;
      fail("time " + text.str() +
           " s: expected at most 9e9 s; is it in another unit? set time.scale");
    }
    const auto stamp = static_cast<Nanoseconds>(std::llround(1e9 * t));
    if (!sheet_.stamp.empty() && stamp <= sheet_.stamp.back()) {
      fail("time does not increase; expected every row later than the one before");
    }
    return stamp;
  }

  void read_row(const std::vector<std::string>& cells) {
    if (cells.size() != header_.size()) {
      fail(std::to_string(cells.size()) + " cells; expected " + std::to_string(header_.size()) +
           ", as in the " + (format_.header == 0 ? "first line" : "header"));
    }
    sheet_.stamp.push_back(time(cells));
    for (std::size_t i = 0; i < places_.size(); ++i) {
      values_[i].push_back(number(cells, places_[i]));
    }
  }

  std::string file_;
  const ForeignFormat& format_;
  std::vector<ForeignColumn> wanted_;
  std::ifstream in_;
  int row_ = 0;
  int first_row_ = 0;
  std::vector<std::string> header_;
  std::size_t time_ = 0;
  std::vector<std::size_t> places_;
  std::vector<std::vector<double>> values_;
  ForeignSheet sheet_;
};

}  // namespace

std::vector<double> ForeignSheet::times() const {
  std::vector<double> t;
  for (const Nanoseconds s : stamp) t.push_back(seconds(s - stamp.front()));
  return t;
}

ForeignSheet read_foreign_sheet(const std::string& file, const ForeignFormat& format,
                                const std::set<ForeignColumn>& wanted) {
  return SheetReader(file, format, wanted).read();
}

}  // namespace anthrob
