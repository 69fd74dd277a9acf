#include "anthrob_recording/dataset_meta.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <set>
#include <sstream>

#include "anthrob_core/config_node.h"
#include "anthrob_recording/table.h"

namespace anthrob {

namespace {

/// Keys of meta.yaml that are meant for people or for identification: `sensors` and `notes`,
/// `measurement` of discovery, and those of the recorder, of rigs, of anthrob_replay and of bags.
bool is_known_key(const std::string& key) {
  static const std::set<std::string> kKnown = {
      "sensors",  "notes", "cut_short",  "from", "hold", "largest_gap", "measurement",  "posture",
      "protocol", "rest",  "rest_drift", "rig",  "run",  "sample",      "simulated_by", "specimen"};
  return kKnown.count(key) > 0 || key.rfind("frame_id_", 0) == 0;
}

void load_start(const ConfigNode& start, DatasetMeta& meta, std::vector<std::string>* remarks) {
  if (!start.is_map()) start.fail_expected("a map of reference and settle_s");
  for (const auto& [key, value] : start.entries()) {
    if (key == "settle_s") {
      meta.settle_s = value.as_number(Bounds::between(0.0, 3600.0), "s");
    } else if (key == "reference") {
      meta.load_start_reference(value);
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

/// "{key: number, ...}"
std::string yaml_map(const std::map<std::string, double>& numbers) {
  YAML::Emitter out;
  out << YAML::Flow << YAML::BeginMap;
  for (const auto& [key, number] : numbers) {
    out << YAML::Key << key << YAML::Value << exact_text(number);
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

void DatasetMeta::load_start_reference(const ConfigNode& reference) {
  if (!reference.is_map()) {
    start = reference.as_text();
    if (start != "first" && start != "zero")
      reference.fail_expected("first, zero or {muscle: rad}");
    return;
  }
  start = "given";
  for (const auto& [muscle, position] : reference.entries()) {
    start_position[muscle] = position.as_number(Bounds::any(), "rad");
  }
}

void DatasetMeta::load_model(const ConfigNode& numbers) {
  if (!numbers.is_map()) numbers.fail_expected("numbers of the model file, {key path: number}");
  for (const auto& [path, value] : numbers.entries()) {
    if (!value.is_scalar()) {
      value.fail("expected a number; keys of the model file are joined by points in one key path");
    }
    const double number = value.as_number(Bounds::any(), "in the unit of the model file");
    if (!std::isfinite(number)) value.fail_expected("a finite number");
    model[path] = number;
  }
}

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
    } else if (key == "model" && !value.is_scalar()) {  // else a name, as of other programs
      meta.load_model(value);
    } else {
      meta.other[key] = value.to_yaml();
      if (!is_known_key(key)) {
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
  if (!meta.model.empty()) out << "model: " << yaml_map(meta.model) << "\n";
  for (const auto& [key, yaml] : meta.other) put_yaml("", key, yaml, out);
  return out.str();
}

}  // namespace anthrob
