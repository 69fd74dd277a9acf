#include "anthrob_sim/recording/dataset.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "anthrob_config/atomic_file.h"
#include "anthrob_sim/core/errors.h"

namespace anthrob {

namespace fs = std::filesystem;

namespace {

const std::array<const char*, 4> kModes = {"VOLTAGE", "POSITION", "CURRENT", "FORCE"};
const std::array<const char*, 5> kStates = {"BOOT", "IDLE", "ENABLED", "STOPPING", "FAULT"};

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

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
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
  explicit TableReader(const fs::path& file) : file_(file.string()), in_(file) {
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
      const int number = number_of(column.quantity(), cell);
      if (number < 0)
        fail(column.name + ": '" + cell + "': expected one of " + words_of(column.quantity()));
      value = number;
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

bool is_known_quantity(const std::string& quantity) {
  static const std::set<std::string> kKnown = {
      "mode",  "reference", "position", "velocity", "current", "voltage",
      "force", "ecu_state", "effort",   "load",     "w",       "x",
      "y",     "z",         "wx",       "wy",       "wz"};
  return kKnown.count(quantity) > 0;
}

bool holds_words(const std::string& quantity) {
  return quantity == "mode" || quantity == "ecu_state";
}

std::string word_of(const std::string& quantity, int value) {
  const bool mode = quantity == "mode";
  const int count = static_cast<int>(mode ? kModes.size() : kStates.size());
  if (value < 0 || value >= count) return std::to_string(value);
  return mode ? kModes[value] : kStates[value];
}

int number_of(const std::string& quantity, const std::string& word) {
  const auto find = [&](const auto& words) {
    const auto it = std::find(words.begin(), words.end(), word);
    return it == words.end() ? -1 : static_cast<int>(it - words.begin());
  };
  const int index = quantity == "mode" ? find(kModes) : find(kStates);
  if (index >= 0) return index;
  int value = -1;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  return result.ec == std::errc() && result.ptr == word.data() + word.size() && value < 256 ? value
                                                                                            : -1;
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

double Series::at(double time) const {
  if (time <= t.front()) return values.front();
  if (time >= t.back()) return values.back();
  const std::size_t next = std::upper_bound(t.begin(), t.end(), time) - t.begin();
  const double share = (time - t[next - 1]) / (t[next] - t[next - 1]);
  return values[next - 1] + share * (values[next] - values[next - 1]);
}

double Series::held_at(double time) const {
  const std::size_t next = std::upper_bound(t.begin(), t.end(), time) - t.begin();
  return values[next == 0 ? 0 : next - 1];
}

double Series::acting_at(double time) const {
  constexpr double kAtFirst = 0.1;  // [s]
  if (empty()) return 0.0;
  return time >= t.front() || t.front() <= kAtFirst ? held_at(time) : 0.0;
}

bool HeldSeries::advance(double time) {
  const std::vector<double>& t = series_->t;
  const std::size_t before = passed_;
  while (passed_ < t.size() && t[passed_] <= time) ++passed_;
  const bool changed = !begun_ || passed_ != before;
  begun_ = true;
  return changed;
}

const Table* Dataset::find_table(const std::string& name) const {
  for (const Table& table : tables) {
    if (table.name == name) return &table;
  }
  return nullptr;
}

Table& Dataset::table(const std::string& name) {
  for (Table& candidate : tables) {
    if (candidate.name == name) return candidate;
  }
  tables.emplace_back();
  tables.back().name = name;
  return tables.back();
}

Nanoseconds Dataset::begin() const {
  Nanoseconds first = 0;
  bool any = false;
  for (const Table& table : tables) {
    if (table.t.empty()) continue;
    first = any ? std::min(first, table.t.front()) : table.t.front();
    any = true;
  }
  return first;
}

Nanoseconds Dataset::end() const {
  Nanoseconds last = 0;
  bool any = false;
  for (const Table& table : tables) {
    if (table.t.empty()) continue;
    last = any ? std::max(last, table.t.back()) : table.t.back();
    any = true;
  }
  return last;
}

Series Dataset::series(const std::string& column) const {
  Series series;
  const Nanoseconds start = begin();
  const auto collect = [&](const Table& table) {
    const Column* found = table.find(column);
    if (!found || !series.empty()) return;
    for (std::size_t i = 0; i < table.t.size(); ++i) {
      if (!found->present[i]) continue;
      series.t.push_back(seconds(table.t[i] - start));
      series.values.push_back(found->values[i]);
    }
  };
  if (const Table* commands = find_table("commands")) collect(*commands);
  for (const Table& table : tables) collect(table);
  return series;
}

namespace {

/// Keys of meta.yaml that say something to people or to identification: `sensors` and `notes`, and
/// those of the recorder, of rigs, of anthrob_replay and of bags.
bool is_told_of(const std::string& key) {
  static const std::set<std::string> kKnown = {
      "sensors", "notes",      "cut_short", "from", "hold",   "largest_gap",  "posture", "protocol",
      "rest",    "rest_drift", "rig",       "run",  "sample", "simulated_by", "specimen"};
  return kKnown.count(key) > 0 || key.rfind("frame_id_", 0) == 0;
}

void load_start(const ConfigNode& start, DatasetMeta& meta, std::vector<std::string>* remarks) {
  if (!start.is_map()) start.fail_expected("a map of reference and settle_s");
  for (const auto& [key, value] : start.entries()) {
    if (key == "settle_s") {
      meta.settle_s = value.as_number(Bounds::nonnegative(), "s");
    } else if (key == "reference" && value.is_map()) {
      meta.start = "given";
      for (const auto& [muscle, position] : value.entries()) {
        meta.start_position[muscle] = position.as_number(Bounds::any(), "rad");
      }
    } else if (key == "reference") {
      meta.start = value.as_text();
      if (meta.start != "first" && meta.start != "zero") {
        value.fail_expected("first, zero or {muscle: rad}");
      }
    } else {
      meta.other_start[key] = value.to_yaml();
      remarks->push_back(value.file() + ": " + value.path() +
                         ": unknown key, kept; expected reference or settle_s");
    }
  }
}

/// A word as YAML has it: in quotes if it needs them.
std::string yaml_word(const std::string& word) {
  YAML::Emitter out;
  out << word;
  return out.c_str();
}

/// "{muscle: rad, ...}"
std::string yaml_map(const std::map<std::string, double>& positions) {
  YAML::Emitter out;
  out << YAML::Flow << YAML::BeginMap;
  for (const auto& [muscle, position] : positions) {
    out << YAML::Key << muscle << YAML::Value << exact_text(position);
  }
  out << YAML::EndMap;
  return out.c_str();
}

/// "key: value", or the value's lines below the key.
void put_yaml(const std::string& indent, const std::string& key, const std::string& yaml,
              std::ostream& out) {
  std::istringstream lines(yaml);
  std::string line;
  out << indent << yaml_word(key) << ":";
  const bool beside =
      ConfigNode::parse(yaml, key).is_scalar() && yaml.find('\n') == yaml.size() - 1;
  while (std::getline(lines, line)) out << (beside ? " " : "\n  " + indent) << line;
  out << "\n";
}

}  // namespace

DatasetMeta load_meta(const std::string& file, std::vector<std::string>* remarks) {
  DatasetMeta meta;
  const ConfigNode node = ConfigNode::load(file);
  for (const auto& [key, value] : node.entries()) {
    if (key == "robot") {
      meta.robot = value.as_text();
    } else if (key == "kind") {
      meta.kind = value.as_text();
      if (meta.kind != "equilibrium" && meta.kind != "trajectory" && meta.kind != "rig") {
        value.fail_expected("equilibrium, trajectory or rig");
      }
    } else if (key == "rate") {
      meta.rate = value.as_number(Bounds::positive(), "Hz");
    } else if (key == "start") {
      load_start(value, meta, remarks);
    } else {
      meta.other[key] = value.to_yaml();
      if (!is_told_of(key)) {
        remarks->push_back(value.file() + ": " + value.path() + ": unknown key, kept");
      }
    }
  }
  return meta;
}

std::string meta_text(const DatasetMeta& meta) {
  std::ostringstream out;
  if (!meta.robot.empty()) out << "robot: " << yaml_word(meta.robot) << "\n";
  out << "kind: " << meta.kind << "\n";
  if (meta.rate > 0.0) out << "rate: " << exact_text(meta.rate) << "  # [Hz]\n";
  out << "start:\n  settle_s: " << exact_text(meta.settle_s)
      << "\n  reference: " << (meta.start == "given" ? yaml_map(meta.start_position) : meta.start)
      << "\n";
  for (const auto& [key, yaml] : meta.other_start) put_yaml("  ", key, yaml, out);
  for (const auto& [key, yaml] : meta.other) put_yaml("", key, yaml, out);
  return out.str();
}

namespace {

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

std::vector<fs::path> csv_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Times are counted in nanoseconds from the first one, in 64 bits.
void refuse_longer_than_counted(const Dataset& dataset) {
  const Nanoseconds begin = dataset.begin(), end = dataset.end();
  if (begin >= 0 || end <= std::numeric_limits<Nanoseconds>::max() + begin) return;
  throw BadInput(dataset.folder + ": times from " + time_text(begin) + " to " + time_text(end) +
                 " s: expected a recording shorter than 9.2e9 s");
}

/// Which of the two would be meant?
void refuse_measured_twice(const Dataset& dataset) {
  std::map<std::string, std::string> places;
  for (const Table& table : dataset.tables) {
    if (table.name == "commands") continue;  // what was asked for stands beside what was done
    for (const Column& column : table.columns) {
      const auto [place, is_new] = places.emplace(column.name, table.name);
      if (is_new) continue;
      throw BadInput(dataset.folder + ": column '" + column.name + "' is in " + place->second +
                     ".csv and in " + table.name + ".csv; expected it in one of them");
    }
  }
}

/// Tables of the recording that stands in a folder, which the one to come has not.
/// @throws BadInput for CSV files that are no part of a recording: they are somebody else's
std::vector<fs::path> tables_to_go(const fs::path& folder, const Dataset& to_come) {
  std::vector<fs::path> tables;
  for (const fs::path& file : csv_files(folder)) {
    if (!fs::exists(folder / "meta.yaml")) {
      throw BadInput(
          file.string() +
          ": this folder has CSV files but no meta.yaml, so it is not a recording that may be "
          "replaced; expected an empty or a new folder");
    }
    if (to_come.find_table(file.stem().string())) continue;
    TableReader(file).read_header();
    tables.push_back(file);
  }
  return tables;
}

/// Who reads it would take the folder for one.
void refuse_name_of_bag(const std::string& target) {
  if (fs::path(target).extension() == ".bag")
    throw BadInput(target + ": expected the name of a dataset folder, not of a bag");
}

}  // namespace

Dataset Dataset::load(const std::string& folder) {
  Dataset dataset;
  dataset.folder = folder;
  if (!fs::is_directory(folder)) throw BadInput(folder + ": expected a dataset folder");
  const fs::path meta = fs::path(folder) / "meta.yaml";
  if (!fs::exists(meta))
    throw BadInput(folder + ": meta.yaml is missing; expected one in a dataset folder");
  dataset.meta = load_meta(meta.string(), &dataset.remarks);
  const std::vector<fs::path> files = csv_files(folder);
  if (files.empty()) throw BadInput(folder + ": expected at least one .csv file beside meta.yaml");
  for (const auto& file : files) dataset.tables.push_back(TableReader(file).read());
  refuse_longer_than_counted(dataset);
  refuse_measured_twice(dataset);
  return dataset;
}

void Dataset::require_place(const std::string& target) const {
  refuse_name_of_bag(target);
  std::error_code error;
  const bool made = fs::create_directories(target, error);
  if (!fs::is_directory(target, error)) {
    throw std::runtime_error(target + ": cannot be created as a folder");
  }
  tables_to_go(target, *this);
  const fs::path probe = fs::path(target) / ".writable";
  write_files_atomically({{probe.string(), ""}});
  fs::remove(probe, error);
  if (made) fs::remove(target, error);
}

void Dataset::save(const std::string& target) const {
  refuse_name_of_bag(target);
  std::error_code error;
  fs::create_directories(target, error);
  if (!fs::is_directory(target, error)) {
    throw std::runtime_error(target + ": cannot be created as a folder");
  }
  const std::vector<fs::path> replaced = tables_to_go(target, *this);
  std::vector<std::pair<std::string, std::string>> files;
  for (const Table& table : tables) {
    files.emplace_back((fs::path(target) / (table.name + ".csv")).string(), table_text(table));
  }
  files.emplace_back((fs::path(target) / "meta.yaml").string(), meta_text(meta));
  write_files_atomically(files);
  for (const fs::path& file : replaced) fs::remove(file);
}

}  // namespace anthrob
