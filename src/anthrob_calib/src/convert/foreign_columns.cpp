#include <set>

#include "anthrob_calib/convert/foreign_csv.h"
#include "anthrob_sim/core/errors.h"
#include "anthrob_sim/model/config_node.h"

namespace anthrob {
namespace {

/// The file where such a quantity is expected first; readers find it in any.
std::string table_of(const std::string& quantity) {
  if (quantity == "mode" || quantity == "reference") return "commands";
  for (const char* muscle : {"current", "voltage", "force", "ecu_state"}) {
    if (quantity == muscle) return "muscles";
  }
  for (const char* joint : {"position", "velocity", "effort", "load"}) {
    if (quantity == joint) return "joints";
  }
  return "spherical_joints";
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
  entry.scale = node.number_or("scale", 1.0, Bounds::any(), "ours per theirs");
  entry.offset = node.number_or("offset", 0.0, Bounds::any(), "ours");
  entry.table = node.text_or("table", table_of(named.quantity()));
  return entry;
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
  columns.meta.settle_s = node.number_or("settle_s", 0.0, Bounds::nonnegative(), "s");
  if (node.has("notes")) columns.meta.other["notes"] = node.at("notes").to_yaml();
  const std::string separator = node.text_or("separator", ",");
  if (separator.size() != 1) node.at("separator").fail_expected("one character");
  columns.separator = separator[0];
  if (node.has("time")) {
    columns.time = node.at("time").text("column");
    columns.time_scale = node.at("time").number_or("scale", 1.0, Bounds::positive(), "s");
  } else {
    columns.rate = node.number("rate", Bounds::positive(), "Hz");
    columns.meta.rate = columns.rate;
  }
  std::set<std::string> seen;
  for (const ConfigNode& item : node.at("columns").items()) {
    columns.entries.push_back(load_entry(item));
    if (!seen.insert(columns.entries.back().to).second) item.at("to").fail("named twice");
  }
  if (columns.entries.empty()) node.at("columns").fail_expected("at least one column");
  node.refuse_unknown_keys();
  return columns;
}

}  // namespace anthrob
