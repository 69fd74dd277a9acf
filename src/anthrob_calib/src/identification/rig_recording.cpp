#include "identification/rig_recording.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace identification {

namespace {

const Table& table_with(const Dataset& recording, const std::string& rig,
                        const std::string& column) {
  for (const Table& table : recording.tables) {
    if (table.find(column)) return table;
  }
  std::string made_by;
  if (!recording.meta.robot.empty()) made_by = " (its robot is '" + recording.meta.robot + "')";
  throw BadInput(recording_name(recording) + ": column '" + column +
                 "' is missing: expected a recording of the " + rig + made_by);
}

[[noreturn]] void fail(const Dataset& recording, const Table& table, std::size_t row,
                       const std::string& message) {
  // Line 1 is the header.
  throw BadInput(recording_name(recording) + "/" + table.name + ".csv:" + std::to_string(row + 2) +
                 ": " + message);
}

}  // namespace

std::string recording_name(const Dataset& recording) {
  return recording.folder.empty() ? "recording" : recording.folder;
}

double RigColumns::period() const {
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

RigColumns read_columns(const Dataset& recording, const std::string& rig,
                        const std::vector<std::string>& names) {
  const Table& table = table_with(recording, rig, names.front());
  if (table.t.size() < 3) {
    throw BadInput(recording_name(recording) + "/" + table.name + ".csv: " +
                   std::to_string(table.t.size()) + " rows: expected a recording of the " + rig);
  }
  RigColumns columns;
  for (std::size_t row = 0; row < table.t.size(); ++row) {
    if (row > 0 && table.t[row] <= table.t[row - 1]) {
      fail(recording, table, row,
           "t: " + time_text(table.t[row]) +
               ": not later than the row before; expected time to grow");
    }
    columns.t.push_back(seconds(table.t[row] - recording.begin()));
  }
  for (const std::string& name : names) {
    const Column* column = table.find(name);
    if (!column) {
      throw BadInput(recording_name(recording) + "/" + table.name + ".csv: column '" + name +
                     "' is missing: expected it beside '" + names.front() + "'");
    }
    for (std::size_t row = 0; row < table.t.size(); ++row) {
      if (!column->present[row]) {
        fail(recording, table, row, name + ": empty: expected a number in every row");
      }
      if (!std::isfinite(column->values[row])) {
        fail(recording, table, row,
             name + ": " + exact_text(column->values[row]) + ": expected a finite number");
      }
    }
    columns.values.push_back(column->values);
  }
  return columns;
}

ConfigNode rig_meta(const Dataset& recording) {
  namespace fs = std::filesystem;
  const std::string file = recording.folder + "/meta.yaml";
  if (!recording.folder.empty() && fs::is_regular_file(file)) return ConfigNode::load(file);
  if (fs::path(recording.folder).extension() == ".bag") {
    throw BadInput(recording.folder +
                   ": a bag does not say what was on the rig; convert it with anthrob_convert and "
                   "add the keys of docs/calibration.md to the folder's meta.yaml");
  }
  std::string text;
  for (const auto& [key, yaml] : recording.meta.other) {
    std::istringstream lines(yaml);
    text += key + ":\n";
    for (std::string line; std::getline(lines, line);) text += "  " + line + "\n";
  }
  return ConfigNode::parse(text.empty() ? "{}" : text, "meta.yaml");
}

}  // namespace identification
}  // namespace anthrob
