#include "measurement/statements.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <tuple>

#include "anthrob_core/config_node.h"
#include "anthrob_core/text.h"
#include "measurement/clock_correction.h"
#include "measurement/column_edits.h"

namespace anthrob {
namespace discovery {

namespace {

/// Quantities of muscles by kind of channel; those of joints have none.
const std::map<std::string, std::vector<std::string>>& kinds() {
  static const std::map<std::string, std::vector<std::string>> kKinds = {
      {"position", {"position", "velocity"}},
      {"velocity", {"velocity"}},
      {"current", {"current"}},
      {"voltage", {"voltage"}},
      {"force", {"force"}},
      {"joint position", {}},
      {"orientation", {}}};
  return kKinds;
}

const std::map<std::string, std::vector<std::string>>& units() {  ///< by `what`
  static const std::map<std::string, std::vector<std::string>> kUnits = {
      {"delay", {"s"}}, {"filter", {"s"}},       {"tick_phase", {"tick"}}, {"sign", {"1"}},
      {"unit", {"1"}},  {"clock", {"s", "ppm"}}, {"hold", {"Hz"}}};
  return kUnits;
}

template <typename Value>
std::string list_of(const std::map<std::string, Value>& map) {
  std::string list;
  for (const auto& [key, value] : map) list += (list.empty() ? "" : ", ") + key;
  return list;
}

bool is_joints_kind(const std::string& kind) {
  return kind == "joint position" || kind == "orientation";
}

bool is_place(const RobotModel& robot, const Dataset& recording, const Statement& statement) {
  if (statement.place == "all") return true;
  if (!is_joints_kind(statement.channel_kind)) return robot.find_muscle(statement.place) >= 0;
  return statement.what == "clock" ? recording.find_table(statement.place) != nullptr
                                   : robot.skeleton->find_joint(statement.place) >= 0;
}

Statement read_statement(const RobotModel& robot, const Dataset& recording,
                         const ConfigNode& node) {
  Statement statement;
  const ConfigNode kind = node.at("channel_kind"), what = node.at("what"), value = node.at("value");
  statement.channel_kind = kind.as_text();
  if (!kinds().count(statement.channel_kind)) kind.fail_expected("one of " + list_of(kinds()));
  statement.what = what.as_text();
  if (!units().count(statement.what)) what.fail_expected("one of " + list_of(units()));
  if (statement.what == "clock" && !is_joints_kind(statement.channel_kind)) {
    kind.fail_expected(
        "joint position or orientation: the clock of the muscles is the one that "
        "counts");
  }
  if (statement.what == "tick_phase" && statement.channel_kind != "voltage") {
    kind.fail_expected("voltage, which alone has a tick_phase");
  }
  if (node.has("place")) statement.place = node.at("place").as_text();
  if (!is_place(robot, recording, statement)) {
    node.at("place").fail_expected("all, or a place that the recording has");
  }
  const std::vector<std::string>& allowed = units().at(statement.what);
  statement.unit = node.has("unit") ? node.at("unit").as_text() : allowed.front();
  if (std::find(allowed.begin(), allowed.end(), statement.unit) == allowed.end()) {
    node.at("unit").fail_expected(allowed.size() > 1 ? allowed.front() + " or " + allowed.back()
                                                     : allowed.front());
  }
  statement.value = value.as_number(Bounds::any(), statement.unit);
  if (!std::isfinite(statement.value)) value.fail_expected("a finite number");
  node.refuse_unknown_keys();
  const bool is_factor = statement.what == "sign" || statement.what == "unit";
  if (is_factor && statement.value == 0.0) value.fail_expected("a factor other than 0");
  if (statement.what == "filter" && statement.value < 0.0) value.fail_expected("a time constant");
  if (statement.what == "tick_phase" && statement.value != 0.0 && statement.value != 1.0) {
    value.fail_expected("1: before the tick at the row's time, or 0: after it");
  }
  return statement;
}

/// Whether a column is one that the statement is about.
bool is_about(const RobotModel& robot, const Statement& statement, const Column& column) {
  if (statement.place != "all" && statement.place != column.owner()) return false;
  if (is_joints_kind(statement.channel_kind)) {
    const int joint = robot.skeleton->find_joint(column.owner());
    if (joint < 0) return false;
    const bool is_ball =
        robot.skeleton->joints[static_cast<std::size_t>(joint)].type == JointType::kBall;
    return is_ball ? statement.channel_kind == "orientation"
                   : statement.channel_kind == "joint position" && column.quantity() == "position";
  }
  const auto& quantities = kinds().at(statement.channel_kind);
  const bool is_factor = statement.what == "sign" || statement.what == "unit";
  return robot.find_muscle(column.owner()) >= 0 &&
         (is_factor ? column.quantity() == quantities.front()
                    : std::find(quantities.begin(), quantities.end(), column.quantity()) !=
                          quantities.end());
}

void undo(const RobotModel& robot, const Statement& statement, Dataset& recording) {
  const auto about = [&](const Column& column) { return is_about(robot, statement, column); };
  if (statement.what == "sign" || statement.what == "unit") {
    divide_columns(recording, about, statement.value);
  } else if (statement.what == "delay") {
    move_columns(recording, about, statement.value);
  } else if (statement.what == "tick_phase" && statement.value == 0.0) {
    double tick = 0.0;
    for (const MuscleModel& muscle : robot.muscles) {
      tick = std::max(tick, muscle.controller.period);
    }
    move_columns(recording, about, -tick);
  } else if (statement.what == "filter") {
    undo_filters(recording, about, statement.value);
  } else if (statement.what == "clock") {
    for (const Table& table : std::vector<Table>(recording.tables)) {
      if (!is_of_joints(robot, table)) continue;
      if (statement.place != "all" && statement.place != table.name) continue;
      const bool is_drift = statement.unit == "ppm";
      move_clock(recording, table.name, is_drift ? 0.0 : statement.value,
                 is_drift ? 1e-6 * statement.value : 0.0);
    }
  }
}

std::string text_of(const MeasurementProperty& row) {
  return row.what + " of " + row.channel_kind + " (" + row.place + ") " + short_number(row.value) +
         " " + row.unit;
}

}  // namespace

std::vector<Statement> statements_of(const RobotModel& robot, const Dataset& recording) {
  const auto text = recording.meta.other.find("measurement");
  if (text == recording.meta.other.end()) return {};
  std::string yaml = "measurement:\n", line;
  for (std::istringstream lines(text->second); std::getline(lines, line);)
    yaml += "  " + line + "\n";
  const ConfigNode list =
      ConfigNode::parse(yaml, recording.folder + "/meta.yaml").at("measurement");
  if (!list.is_sequence()) list.fail_expected("a list of {channel_kind, place, what, value, unit}");
  std::vector<Statement> statements;
  for (const ConfigNode& node : list.items()) {
    statements.push_back(read_statement(robot, recording, node));
  }
  return statements;
}

void correct_as_stated(const RobotModel& robot, Description& description) {
  std::map<std::tuple<std::string, std::string, std::string, double>, std::size_t> told;
  for (Dataset* recording : recordings_of(description.question)) {
    for (const Statement& s : statements_of(robot, *recording)) {
      if (s.what != "hold") {
        undo(robot, s, *recording);
        description.corrected = true;
      }
      if (told[{s.channel_kind, s.place, s.what + s.unit, s.value}]++ > 0) continue;
      description.measurement.push_back(
          {s.channel_kind, s.place, s.what, s.value, {s.value, s.value}, s.unit, "meta"});
    }
  }
}

void tell_contradictions(Description& description) {
  for (const MeasurementProperty& stated : description.measurement) {
    if (stated.source != "meta") continue;
    for (const MeasurementProperty& found : description.measurement) {
      if (found.source != "found" || found.channel_kind != stated.channel_kind) continue;
      const bool is_hold = stated.what == "hold" && found.what == "hold";
      if (is_hold && stated.value >= found.ci95[0] && stated.value <= found.ci95[1]) continue;
      if (found.what != stated.what) continue;
      description.remarks.push_back("meta.yaml states a " + text_of(stated) +
                                    ", but the recordings say otherwise: " +
                                    (is_hold ? "" : "beside it, a ") + text_of(found));
    }
  }
}

}  // namespace discovery
}  // namespace anthrob
