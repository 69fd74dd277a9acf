#include <cmath>
#include <optional>
#include <set>

#include "anthrob_core/config_node.h"
#include "anthrob_core/errors.h"
#include "anthrob_recording/quantities.h"
#include "foreign/foreign_csv.h"

namespace anthrob {
namespace {

bool is_of_muscles(const std::string& quantity) {
  for (const char* muscle : {"reference", "current", "voltage", "force"}) {
    if (quantity == muscle) return true;
  }
  return false;
}

/// The file where such a quantity is expected first; readers find it in any.
std::string table_of(const std::string& quantity, bool muscle) {
  if (quantity == "reference") return "commands";
  if (is_push_quantity(quantity)) return "wrenches";
  if (is_of_muscles(quantity)) return "muscles";
  if (quantity == "position" || quantity == "velocity") return muscle ? "muscles" : "joints";
  return quantity == "effort" || quantity == "load" ? "joints" : "spherical_joints";
}

/// The name of a table, which becomes that of a file in the folder of the recording.
std::string load_table(const ConfigNode& node, const std::string& otherwise) {
  if (!node.has("table")) return otherwise;
  const std::string table = node.text("table");
  constexpr const char* kAllowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  if (table.empty() || table.find_first_not_of(kAllowed) != std::string::npos) {
    node.at("table").fail_expected("a name of letters, digits, _ and -");
  }
  return table;
}

ForeignColumns::Entry load_entry(const ConfigNode& node) {
  ForeignColumns::Entry entry;
  entry.from = node.text("from");
  entry.to = node.text("to");
  const Column named{entry.to, {}, {}};
  if (entry.to.find('/') == std::string::npos || !is_known_quantity(named.quantity()) ||
      holds_words(named.quantity())) {
    node.at("to").fail_expected("<muscle or joint>/<quantity of numbers>, as in docs/files.md");
  }
  entry.scale = node.number_or("scale", 1.0, Bounds::any(), "unit of to per unit of from");
  if (entry.scale == 0.0) node.at("scale").fail_expected("a number other than 0");
  entry.offset = node.number_or("offset", 0.0, Bounds::any(), "unit of to");
  entry.table = load_table(node, "");
  return entry;
}

bool is_order(const std::string& text) {
  return text.size() == 3 && text.find_first_not_of("xyz") == std::string::npos &&
         text[0] != text[1] && text[1] != text[2];
}

ForeignColumns::Orientation load_orientation(const ConfigNode& node) {
  ForeignColumns::Orientation orientation;
  orientation.joint = node.text("to");
  if (orientation.joint.find('/') != std::string::npos) {
    node.at("to").fail_expected("the name of a ball joint");
  }
  const bool euler = node.has("euler");
  const ConfigNode angles = node.at(euler ? "euler" : "rotation_vector");
  const std::vector<ConfigNode> from = angles.at("from").items();
  if (from.size() != 3) angles.at("from").fail("expected three columns");
  for (std::size_t i = 0; i < 3; ++i) orientation.from[i] = from[i].as_text();
  if (euler) {
    orientation.order = angles.text("order");
    if (!is_order(orientation.order)) {
      angles.at("order").fail_expected("three of x, y and z, no two neighbours equal");
    }
  }
  const std::string unit = angles.text_or("unit", "rad");
  if (unit != "rad" && unit != "deg") angles.at("unit").fail_expected("rad or deg");
  orientation.unit = unit == "deg" ? M_PI / 180.0 : 1.0;
  orientation.table = load_table(node, "spherical_joints");
  return orientation;
}

int mode_of(const ConfigNode& node) {
  const std::string word = node.as_text();
  const std::optional<int> mode = number_of("mode", word);
  if (!mode || word_of("mode", *mode) != word) {
    node.fail_expected("VOLTAGE, POSITION, CURRENT or FORCE");
  }
  return *mode;
}

/// Gives references their modes, one for all or by muscle.
void load_modes(const ConfigNode& node, std::vector<ForeignColumns::Entry>& entries) {
  const auto give = [&](const ConfigNode& word, const std::string& muscle) {
    const int mode = mode_of(word);
    bool any = false;
    for (ForeignColumns::Entry& entry : entries) {
      const Column named{entry.to, {}, {}};
      if (named.quantity() != "reference") continue;
      if (!muscle.empty() && named.owner() != muscle) continue;
      entry.mode = mode;
      any = true;
    }
    if (!any) word.fail("no column has to: " + (muscle.empty() ? "MUSCLE" : muscle) + "/reference");
  };
  if (!node.is_map()) return give(node, "");
  for (const auto& [muscle, word] : node.entries()) give(word, muscle);
}

/// Chooses the tables that are not given, by whether the list has a quantity of muscles under that
/// name.
void choose_tables(std::vector<ForeignColumns::Entry>& entries) {
  std::set<std::string> muscles;
  for (const ForeignColumns::Entry& entry : entries) {
    const Column named{entry.to, {}, {}};
    if (is_of_muscles(named.quantity())) muscles.insert(named.owner());
  }
  for (ForeignColumns::Entry& entry : entries) {
    const Column named{entry.to, {}, {}};
    if (entry.table.empty()) {
      entry.table = table_of(named.quantity(), muscles.count(named.owner()) > 0);
    }
  }
}

}  // namespace

ForeignColumns ForeignColumns::load(const std::string& file) {
  const ConfigNode node = ConfigNode::load(file);
  ForeignColumns columns;
  columns.file = file;
  columns.meta.robot = node.text("robot");
  columns.meta.kind = node.text_or("kind", "trajectory");
  if (columns.meta.kind != "equilibrium" && columns.meta.kind != "trajectory" &&
      columns.meta.kind != "rig") {
    node.at("kind").fail_expected("equilibrium, trajectory or rig");
  }
  columns.meta.settle_s =
      node.number_or("settle_s", columns.meta.settle_s, Bounds::nonnegative(), "s");
  if (node.has("start")) columns.meta.load_start_reference(node.at("start"));
  if (node.has("notes")) columns.meta.other["notes"] = node.at("notes").to_yaml();
  const std::string separator = node.text_or("separator", ",");
  if (separator.size() != 1) node.at("separator").fail_expected("one character");
  columns.separator = separator[0];
  if (node.has("time") && node.has("rate")) {
    node.at("rate").fail("beside 'time': expected only one of them");
  }
  if (node.has("time")) {
    columns.time = node.at("time").text("column");
    columns.time_scale = node.at("time").number_or("scale", 1.0, Bounds::positive(), "s");
  } else if (!node.has("rate")) {
    node.fail("expected the key 'time' or, if there is no column of times, 'rate' [Hz]");
  } else {
    columns.rate = node.number("rate", Bounds::positive(), "Hz");
    columns.meta.rate = columns.rate;
  }
  std::set<std::string> seen;
  const auto refuse_twice = [&](const ConfigNode& item, const std::string& to) {
    if (!seen.insert(to).second) item.at("to").fail("used twice; expected each quantity once");
  };
  for (const ConfigNode& item : node.at("columns").items()) {
    if (item.has("euler") || item.has("rotation_vector")) {
      columns.orientations.push_back(load_orientation(item));
      for (const char* part : {"/w", "/x", "/y", "/z"}) {
        refuse_twice(item, columns.orientations.back().joint + part);
      }
    } else {
      columns.entries.push_back(load_entry(item));
      refuse_twice(item, columns.entries.back().to);
    }
  }
  if (seen.empty()) node.at("columns").fail_expected("at least one column");
  choose_tables(columns.entries);
  if (node.has("mode")) load_modes(node.at("mode"), columns.entries);
  node.refuse_unknown_keys();
  return columns;
}

}  // namespace anthrob
