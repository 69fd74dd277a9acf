#include "foreign/foreign_csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"

namespace anthrob {
namespace {

constexpr const char* kParts[] = {"/w", "/x", "/y", "/z"};
constexpr double kLatest = 9e9;  ///< [s] nanoseconds of 64 bits end there
constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

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

class ForeignReader {
 public:
  ForeignReader(const std::string& file, const ForeignColumns& columns)
      : file_(file), columns_(columns), in_(file) {}

  Dataset read() {
    if (!in_) throw BadInput(file_ + ": cannot be read");
    Dataset dataset;
    dataset.folder = file_;
    dataset.meta = columns_.meta;
    read_header();
    // Tables first: a reference to a column must not move.
    for (const ForeignColumns::Entry& entry : columns_.entries) {
      dataset.table(entry.table).column(entry.to);
      if (entry.mode) dataset.table(entry.table).column(mode_column(entry));
    }
    for (const ForeignColumns::Orientation& orientation : columns_.orientations) {
      for (const char* part : kParts) {
        dataset.table(orientation.table).column(orientation.joint + part);
      }
    }
    int blank = 0;  // the first line without anything, 0: none
    for (std::string line; std::getline(in_, line);) {
      ++row_;
      if (trimmed(line, kBlank).empty()) {
        if (blank == 0) blank = row_;
        continue;
      }
      // Time counts rows: is this one, in which nothing was measured, or none?
      if (blank > 0 && columns_.time.empty()) {
        row_ = blank;
        fail("an empty row; expected none, because `rate` counts rows");
      }
      refuse_open_quote(line);
      read_row(cells_of(line, columns_.separator), &dataset);
    }
    if (dataset.tables.front().t.size() < 2) {
      throw BadInput(file_ + ": fewer than two rows; expected a recording");
    }
    return dataset;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw BadInput(file_ + ":" + std::to_string(row_) + ": " + message);
  }

  void read_header() {
    std::string line;
    row_ = 1;
    std::getline(in_, line);
    constexpr const char* kByteOrderMark = "\xef\xbb\xbf";
    if (line.rfind(kByteOrderMark, 0) == 0) line.erase(0, 3);
    refuse_other_text(line);
    header_ = cells_of(line, columns_.separator);
    if (!columns_.time.empty()) time_ = place_of(columns_.time);
    for (const ForeignColumns::Entry& entry : columns_.entries) {
      places_.push_back(place_of(entry.from));
    }
    for (const ForeignColumns::Orientation& orientation : columns_.orientations) {
      for (const std::string& from : orientation.from) angle_places_.push_back(place_of(from));
    }
  }

  /// What other programs write, but no table of lines.
  void refuse_other_text(const std::string& header) const {
    if (header.find('\0') != std::string::npos) {
      fail("not text in UTF-8; expected a table in UTF-8 (saved as UTF-16?)");
    }
    const std::size_t cr = header.find('\r');
    if (cr != std::string::npos && cr + 1 < header.size()) {
      fail("lines end with CR alone, as on old Macs; expected LF or CR LF");
    }
    refuse_open_quote(header);
  }

  void refuse_open_quote(const std::string& line) const {
    if (std::count(line.begin(), line.end(), '"') % 2 == 0) return;
    fail("a quote that has no end in its line; expected every row, and every name, in one line");
  }

  std::size_t place_of(const std::string& name) const {
    const auto found = std::find(header_.begin(), header_.end(), name);
    if (found != header_.end()) {
      if (std::find(found + 1, header_.end(), name) != header_.end()) {
        throw BadInput(file_ + ": column '" + name + "' appears twice; expected it once");
      }
      return static_cast<std::size_t>(found - header_.begin());
    }
    std::string there;
    for (const std::string& column : header_) there += (there.empty() ? "" : ", ") + column;
    throw BadInput(columns_.file + ": column '" + name + "' is not in " + file_ +
                   (there.empty() ? ", which is empty" : "; expected one of: " + there));
  }

  double number(const std::vector<std::string>& cells, std::size_t place) const {
    const std::string& cell = cells[place];
    if (cell.empty()) return kNotMeasured;
    double value = 0.0;
    const char* begin = cell.data() + (cell[0] == '+' ? 1 : 0);
    const char* end = cell.data() + cell.size();
    const auto result = std::from_chars(begin, end, value);
    if (result.ec != std::errc() || result.ptr != end || !std::isfinite(value)) {
      fail("column '" + header_[place] + "': '" + cell + "': expected a number");
    }
    return value;
  }

  Nanoseconds time(const std::vector<std::string>& cells) {
    double t = static_cast<double>(count_++) / columns_.rate;
    if (!columns_.time.empty()) t = columns_.time_scale * number(cells, time_);
    if (!std::isfinite(t)) fail("column '" + columns_.time + "': empty; expected a time");
    if (std::abs(t) > kLatest) {
      std::ostringstream text;
      text << t;
      fail("time " + text.str() +
           " s: expected at most 9e9 s; is it in another unit? set time.scale");
    }
    const auto stamp = static_cast<Nanoseconds>(std::llround(1e9 * t));
    if (count_ > 1 && stamp <= last_)
      fail("time does not increase; expected every row later than the one before");
    return last_ = stamp;
  }

  void read_row(const std::vector<std::string>& cells, Dataset* dataset) {
    if (cells.size() != header_.size()) {
      fail(std::to_string(cells.size()) + " cells; expected " + std::to_string(header_.size()) +
           ", as in the header");
    }
    const Nanoseconds t = time(cells);
    for (Table& table : dataset->tables) table.t.push_back(t);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const ForeignColumns::Entry& entry = columns_.entries[i];
      Table& table = dataset->table(entry.table);
      const double value = number(cells, places_[i]);
      put(table, entry.to, entry.scale * value + entry.offset);
      if (entry.mode) put(table, mode_column(entry), std::isfinite(value) ? *entry.mode : value);
    }
    for (std::size_t i = 0; i < columns_.orientations.size(); ++i) {
      put_orientation(cells, columns_.orientations[i], &angle_places_[3 * i], dataset);
    }
  }

  void put_orientation(const std::vector<std::string>& cells,
                       const ForeignColumns::Orientation& orientation, const std::size_t* places,
                       Dataset* dataset) {
    Eigen::Vector3d angles;
    for (int k = 0; k < 3; ++k) angles[k] = orientation.unit * number(cells, places[k]);
    std::array<double, 4> parts;
    parts.fill(kNotMeasured);
    if (angles.allFinite()) {
      const Eigen::Quaterniond q = orientation.order.empty()
                                       ? from_rotation_vector(angles)
                                       : from_euler(orientation.order, angles);
      parts = {q.w(), q.x(), q.y(), q.z()};
    }
    Table& table = dataset->table(orientation.table);
    for (std::size_t k = 0; k < 4; ++k) put(table, orientation.joint + kParts[k], parts[k]);
  }

  static void put(Table& table, const std::string& name, double value) {
    Column& column = table.column(name);
    const bool present = std::isfinite(value);
    column.values.push_back(present ? value : 0.0);
    column.present.push_back(present);
  }

  static std::string mode_column(const ForeignColumns::Entry& entry) {
    return Column{entry.to, {}, {}}.owner() + "/mode";
  }

  std::string file_;
  const ForeignColumns& columns_;
  std::ifstream in_;
  int row_ = 0;
  std::vector<std::string> header_;
  std::size_t time_ = 0;
  std::vector<std::size_t> places_;
  std::vector<std::size_t> angle_places_;  ///< three an orientation
  int count_ = 0;
  Nanoseconds last_ = 0;
};

Eigen::Quaterniond one_of_two(const Eigen::Quaterniond& q) {
  return q.w() < 0.0 ? Eigen::Quaterniond(-q.coeffs()) : q;
}

}  // namespace

Eigen::Quaterniond from_euler(const std::string& order, const Eigen::Vector3d& angles) {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(order[static_cast<std::size_t>(k)] - 'x');
    q = q * Eigen::AngleAxisd(angles[k], axis);
  }
  return one_of_two(q.normalized());
}

Eigen::Quaterniond from_rotation_vector(const Eigen::Vector3d& rotation) {
  const double angle = rotation.stableNorm();
  if (angle == 0.0) return Eigen::Quaterniond::Identity();
  return one_of_two(Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation / angle)).normalized());
}

Dataset read_foreign_csv(const std::string& file, const ForeignColumns& columns) {
  return ForeignReader(file, columns).read();
}

}  // namespace anthrob
