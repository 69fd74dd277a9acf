#include "anthrob_recording/dataset.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <utility>

#include "anthrob_core/errors.h"
#include "anthrob_core/files.h"
#include "dataset/clocks.h"
#include "dataset/sources.h"
#include "dataset/table_file.h"

namespace anthrob {

namespace fs = std::filesystem;

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

/// Refuses a column that stands in two files.
void refuse_measured_twice(const Dataset& dataset) {
  std::map<std::string, std::string> places;
  for (const Table& table : dataset.tables) {
    if (table.name == "commands") continue;  // a command and its echo may stand side by side
    for (const Column& column : table.columns) {
      const auto [place, is_new] = places.emplace(column.name, table.name);
      if (is_new) continue;
      throw BadInput(dataset.folder + ": column '" + column.name + "' is in " + place->second +
                     ".csv and in " + table.name + ".csv; expected it in one of them");
    }
  }
}

/// CSV files of the existing recording that the new one does not overwrite.
/// @throws BadInput for CSV files that are no part of a recording
std::vector<fs::path> obsolete_tables(const fs::path& folder, const Dataset& replacement) {
  std::vector<fs::path> tables;
  for (const fs::path& file : csv_files(folder)) {
    if (!fs::exists(folder / "meta.yaml")) {
      throw BadInput(
          file.string() +
          ": this folder has CSV files but no meta.yaml, so it is not a recording that may be "
          "replaced; expected an empty or a new folder");
    }
    if (replacement.find_table(file.stem().string())) continue;
    require_table_header(file);
    tables.push_back(file);
  }
  return tables;
}

/// A folder named *.bag would be read as a bag.
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
  for (const auto& file : files) dataset.tables.push_back(read_table(file));
  refuse_longer_than_counted(dataset);
  refuse_measured_twice(dataset);
  check_clocks(dataset);
  check_sources(dataset);
  return dataset;
}

void Dataset::require_place(const std::string& target) const {
  refuse_name_of_bag(target);
  MadeFolder made(target);
  if (!made.exists()) throw std::runtime_error(target + ": cannot be created as a folder");
  obsolete_tables(target, *this);
  const fs::path probe = fs::path(target) / ".writable";
  write_files_atomically({{probe.string(), ""}});
  std::error_code error;
  fs::remove(probe, error);
  made.take_back();
}

void Dataset::save(const std::string& target) const {
  refuse_name_of_bag(target);
  std::error_code error;
  fs::create_directories(target, error);
  if (!fs::is_directory(target, error)) {
    throw std::runtime_error(target + ": cannot be created as a folder");
  }
  const std::vector<fs::path> replaced = obsolete_tables(target, *this);
  std::vector<std::pair<std::string, std::string>> files;
  for (const Table& table : tables) {
    files.emplace_back((fs::path(target) / (table.name + ".csv")).string(), table_text(table));
  }
  files.emplace_back((fs::path(target) / "meta.yaml").string(), meta_text(meta));
  write_files_atomically(files);
  for (const fs::path& file : replaced) fs::remove(file);
}

}  // namespace anthrob
