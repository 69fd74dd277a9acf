#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "anthrob_core/config_node.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
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

ForeignStream::Entry load_entry(const ConfigNode& node) {
  ForeignStream::Entry entry{ForeignValue::load(node.at("from")), node.text("to")};
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

ForeignStream::Orientation load_orientation(const ConfigNode& node) {
  ForeignStream::Orientation orientation;
  orientation.joint = node.text("to");
  if (orientation.joint.find('/') != std::string::npos) {
    node.at("to").fail_expected("the name of a ball joint");
  }
  const bool euler = node.has("euler");
  const ConfigNode angles = node.at(euler ? "euler" : "rotation_vector");
  const std::vector<ConfigNode> from = angles.at("from").items();
  if (from.size() != 3) angles.at("from").fail("expected three columns");
  for (const ConfigNode& item : from) orientation.from.push_back(ForeignValue::load(item));
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
void load_modes(const ConfigNode& node, std::vector<ForeignStream>& streams) {
  const auto give = [&](const ConfigNode& word, const std::string& muscle) {
    const int mode = mode_of(word);
    bool any = false;
    for (ForeignStream& stream : streams) {
      for (ForeignStream::Entry& entry : stream.entries) {
        const Column named{entry.to, {}, {}};
        if (named.quantity() != "reference") continue;
        if (!muscle.empty() && named.owner() != muscle) continue;
        entry.mode = mode;
        any = true;
      }
    }
    if (!any) word.fail("no column has to: " + (muscle.empty() ? "MUSCLE" : muscle) + "/reference");
  };
  if (!node.is_map()) return give(node, "");
  for (const auto& [muscle, word] : node.entries()) give(word, muscle);
}

/// Chooses the tables that are not given, by whether the list has a quantity of muscles under that
/// name.
void choose_tables(std::vector<ForeignStream>& streams) {
  std::set<std::string> muscles;
  for (const ForeignStream& stream : streams) {
    for (const ForeignStream::Entry& entry : stream.entries) {
      const Column named{entry.to, {}, {}};
      if (is_of_muscles(named.quantity())) muscles.insert(named.owner());
    }
  }
  for (ForeignStream& stream : streams) {
    for (ForeignStream::Entry& entry : stream.entries) {
      const Column named{entry.to, {}, {}};
      if (entry.table.empty()) {
        entry.table = table_of(named.quantity(), muscles.count(named.owner()) > 0);
      }
    }
  }
}

/// Streams keep their clocks: a table that two of them would share becomes one for each,
/// joints_encoder and joints_torque.
void part_tables(std::vector<ForeignStream>& streams) {
  std::map<std::string, std::set<std::string>> users;
  const auto each = [&](const auto& use) {
    for (ForeignStream& stream : streams) {
      for (ForeignStream::Entry& entry : stream.entries) use(stream, entry.table);
      for (ForeignStream::Orientation& joint : stream.orientations) use(stream, joint.table);
    }
  };
  each([&](const ForeignStream& stream, std::string& table) { users[table].insert(stream.name); });
  each([&](const ForeignStream& stream, std::string& table) {
    if (users[table].size() > 1) table += "_" + stream.name;
  });
}

char load_character(const ConfigNode& node, const std::string& key, char otherwise) {
  const std::string text = node.text_or(key, std::string(1, otherwise));
  if (text.size() != 1) node.at(key).fail_expected("one character");
  return text[0];
}

ForeignFormat load_format(const ConfigNode& node) {
  ForeignFormat format;
  format.map = node.file();
  format.separator = load_character(node, "separator", format.separator);
  format.decimal = load_character(node, "decimal", format.decimal);
  if (format.decimal != '.' && format.decimal != ',') {
    node.at("decimal").fail_expected("\".\" or \",\"");
  }
  if (format.decimal == format.separator) {
    node.at("decimal").fail_expected("another character than the separator");
  }
  if (node.has("header")) format.header = node.at("header").as_integer(0, 100000);
  if (node.has("skip")) format.skip = node.at("skip").as_integer(0, 100000);
  if (node.has("time") && node.has("rate")) {
    node.at("rate").fail("beside 'time': expected only one of them");
  }
  if (node.has("time")) {
    const ConfigNode time = node.at("time");
    format.time = load_foreign_column(time);
    format.time_scale = time.number_or("scale", 1.0, Bounds::positive(), "s");
    format.time_offset = time.number_or("offset", 0.0, Bounds::any(), "s");
  } else if (!node.has("rate")) {
    node.fail("expected the key 'time' or, if there is no column of times, 'rate' [Hz]");
  } else {
    format.rate = node.number("rate", Bounds::positive(), "Hz");
  }
  return format;
}

/// @param seen gets what the stream measures, which no other may
ForeignStream load_stream(const ConfigNode& node, std::set<std::string>& seen) {
  ForeignStream stream;
  stream.format = load_format(node);
  const auto refuse_twice = [&](const ConfigNode& item, const std::string& to) {
    if (!seen.insert(to).second) item.at("to").fail("used twice; expected each quantity once");
  };
  for (const ConfigNode& item : node.at("columns").items()) {
    if (item.has("euler") || item.has("rotation_vector")) {
      stream.orientations.push_back(load_orientation(item));
      for (const char* part : {"/w", "/x", "/y", "/z"}) {
        refuse_twice(item, stream.orientations.back().joint + part);
      }
    } else {
      stream.entries.push_back(load_entry(item));
      refuse_twice(item, stream.entries.back().to);
    }
  }
  if (stream.entries.empty() && stream.orientations.empty()) {
    node.at("columns").fail_expected("at least one column");
  }
  return stream;
}

std::vector<ForeignStream> load_streams(const ConfigNode& node) {
  std::set<std::string> seen;
  if (!node.has("streams")) return {load_stream(node, seen)};
  for (const char* key : {"time", "rate", "columns", "separator", "decimal", "header", "skip"}) {
    if (node.has(key)) node.at(key).fail("beside 'streams': expected it in each of them");
  }
  std::vector<ForeignStream> streams;
  for (const auto& [name, part] : node.at("streams").entries()) {
    if (!is_snake_case(name)) part.fail("expected a lower-case name of letters, digits and _");
    streams.push_back(load_stream(part, seen));
    streams.back().name = name;
    streams.back().file = part.text("file");
  }
  if (streams.empty()) node.at("streams").fail("expected at least one stream");
  return streams;
}

/// When a push ends is told by a row without it, which a time base does not have.
void refuse_pushes(const ConfigNode& rows, const std::vector<ForeignStream>& streams) {
  for (const ForeignStream& stream : streams) {
    for (const ForeignStream::Entry& entry : stream.entries) {
      if (!is_push_quantity(Column{entry.to, {}, {}}.quantity())) continue;
      rows.fail("beside " + entry.to + ": expected pushes with times of their own, without rows");
    }
  }
}

std::vector<Piece> load_split(const ConfigNode& node) {
  std::vector<Piece> pieces;
  for (const auto& [name, interval] : node.entries()) {
    if (!is_snake_case(name)) interval.fail("expected a lower-case name of letters, digits and _");
    const std::vector<double> ends = interval.as_numbers(2, "s");
    if (ends[0] < 0.0 || ends[0] >= ends[1]) {
      interval.fail("expected [from, to] in seconds since the first row, from below to");
    }
    pieces.push_back({name, ends[0], ends[1]});
  }
  if (pieces.empty()) node.fail("expected {name: [from, to], ...}");
  return pieces;
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
  if (node.has("model")) columns.meta.load_model(node.at("model"));
  if (node.has("notes")) columns.meta.other["notes"] = node.at("notes").to_yaml();
  columns.streams = load_streams(node);
  if (columns.streams.size() == 1) columns.meta.rate = columns.streams.front().format.rate;
  choose_tables(columns.streams);
  if (node.has("rows")) {
    columns.rows = node.number("rows", Bounds::between(1e-3, 1e6), "Hz");
    columns.meta.rate = columns.rows;
    refuse_pushes(node.at("rows"), columns.streams);
  } else {
    part_tables(columns.streams);
  }
  if (node.has("mode")) load_modes(node.at("mode"), columns.streams);
  if (node.has("split")) columns.split = load_split(node.at("split"));
  node.refuse_unknown_keys();
  return columns;
}

}  // namespace anthrob
