#include "anthrob_core/config_node.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "require_file.h"

namespace anthrob {

enum class NodeKind { kNull, kScalar, kSequence, kMap };

struct ConfigNode::Data {
  NodeKind kind = NodeKind::kNull;
  std::string scalar;
  std::vector<std::shared_ptr<Data>> items;
  std::vector<std::pair<std::string, std::shared_ptr<Data>>> entries;
  std::shared_ptr<const std::string> file;
  int line = 0;
  bool read = false;

  std::shared_ptr<Data> find(const std::string& key) const {
    for (const auto& entry : entries) {
      if (entry.first == key) return entry.second;
    }
    return nullptr;
  }
};

namespace {

using Data = ConfigNode::Data;
using DataPtr = std::shared_ptr<Data>;

/// One line, whatever it quotes; both ends of one that quotes more than anybody reads.
std::string readable(std::string message) {
  constexpr std::size_t kLongest = 2000, kEnd = 500;
  for (char& c : message) c = c == '\n' || c == '\r' ? ' ' : c;
  if (message.size() <= kLongest) return message;
  return message.substr(0, kLongest - kEnd) + " [...] " + message.substr(message.size() - kEnd);
}

[[noreturn]] void fail_at(const std::string& file, int line, const std::string& message) {
  throw BadInput(file + ":" + std::to_string(line) + ": " + readable(message));
}

std::string join(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

bool is_number_of_digits(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

/// YAML that means something else than it seems to, in an entry that comes after those of `map`.
void refuse_misleading(const std::string& key, const YAML::Node& value, const Data& map, int line) {
  if (key == "<<") {
    fail_at(*map.file, line, "<<: merge keys are not read; expected extends, or the keys again");
  }
  if (!value.IsNull() || !is_number_of_digits(key) || map.entries.empty()) return;
  const auto& [name, before] = map.entries.back();
  if (before->kind != NodeKind::kScalar) return;
  const bool is_signed =
      !before->scalar.empty() && (before->scalar[0] == '-' || before->scalar[0] == '+');
  if (!is_number_of_digits(before->scalar.substr(is_signed ? 1 : 0))) return;
  fail_at(*map.file, line,
          name + ": " + before->scalar + "," + key + ": a decimal comma? expected " +
              before->scalar + "." + key);
}

/// No sensible file is nested deeper; an alias inside its own anchor would never end.
constexpr int kDeepest = 100;
/// Nor has any so many values, once each alias is what it stands for, or extends so many files.
constexpr std::size_t kMostValues = 1000000, kMostFiles = 100;

/// What was read for one file and those that it extends.
struct Reading {
  std::vector<std::string> chain;  ///< of files, each of which extends the next
  std::size_t files = 0, values = 0;
};

DataPtr convert(const YAML::Node& node, const std::shared_ptr<const std::string>& file,
                Reading& reading, int depth = 0) {
  if (++reading.values > kMostValues) {
    fail_at(*file, node.Mark().line + 1,
            "more than " + std::to_string(kMostValues) +
                " values; expected fewer, and no aliases that repeat each other");
  }
  if (depth > kDeepest) {
    fail_at(*file, node.Mark().line + 1,
            "nested more than " + std::to_string(kDeepest) +
                " deep; expected fewer levels, and no alias inside its own anchor");
  }
  auto data = std::make_shared<Data>();
  data->file = file;
  data->line = node.Mark().line + 1;
  switch (node.Type()) {
    case YAML::NodeType::Scalar:
      data->kind = NodeKind::kScalar;
      data->scalar = node.Scalar();
      break;
    case YAML::NodeType::Sequence:
      data->kind = NodeKind::kSequence;
      for (const auto& item : node) {
        data->items.push_back(convert(item, file, reading, depth + 1));
      }
      break;
    case YAML::NodeType::Map:
      data->kind = NodeKind::kMap;
      for (const auto& entry : node) {
        const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
        if (key.empty()) {
          // An empty key has no mark of its own.
          const int line = std::max(entry.first.Mark().line, node.Mark().line);
          fail_at(*file, line + 1, "a key that is no word: expected KEY: VALUE");
        }
        if (data->find(key)) {
          fail_at(*file, entry.first.Mark().line + 1, key + ": appears twice in the same map");
        }
        refuse_misleading(key, entry.second, *data, entry.first.Mark().line + 1);
        data->entries.emplace_back(key, convert(entry.second, file, reading, depth + 1));
        // An empty value has no mark of its own.
        data->entries.back().second->line = entry.first.Mark().line + 1;
      }
      break;
    default:
      break;
  }
  return data;
}

/// @param path of the maps in their file
DataPtr merge(const DataPtr& base, const DataPtr& over, const std::string& path = "") {
  if (base->kind != NodeKind::kMap || over->kind != NodeKind::kMap) return over;
  auto merged = std::make_shared<Data>(*base);
  merged->file = over->file;
  merged->line = over->line;
  for (const auto& [key, value] : over->entries) {
    auto& entries = merged->entries;
    const auto entry = std::find_if(entries.begin(), entries.end(),
                                    [&, name = key](const auto& e) { return e.first == name; });
    const std::string where = join(path, key);
    if (value->kind == NodeKind::kNull) {
      if (entry == entries.end()) {
        fail_at(
            *value->file, value->line,
            where + ": unknown key; without a value it removes one of the file that is extended");
      }
      entries.erase(entry);
    } else if (entry != entries.end()) {
      entry->second = merge(entry->second, value, where);
    } else {
      entries.emplace_back(key, value);
    }
  }
  return merged;
}

/// The file that an entry of `extends` names, beside the file that says so.
std::string base_file(const std::string& path, const Data& name) {
  if (name.kind != NodeKind::kScalar) {
    fail_at(path, name.line, "extends: expected the name of a YAML file, or a list");
  }
  const auto base = std::filesystem::path(path).parent_path() / name.scalar;
  if (!std::filesystem::exists(base)) {
    fail_at(path, name.line, "extends: " + name.scalar + ": no such file beside this one");
  }
  return base.string();
}

/// Notes where the documents of a file begin.
class Beginnings final : public YAML::EventHandler {
 public:
  std::vector<YAML::Mark> of_documents;

  void OnDocumentStart(const YAML::Mark& mark) override { of_documents.push_back(mark); }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

/// Whatever follows a second "---" must not be ignored silently. Of a comma outside of all lists
/// yaml-cpp takes every look for one more document: YAML::LoadAll would never end.
void expect_one_document(const std::string& text, const std::string& path) {
  std::istringstream in(text);
  YAML::Parser parser(in);
  Beginnings beginnings;
  while (beginnings.of_documents.size() < 2 && parser.HandleNextDocument(beginnings)) {
  }
  if (beginnings.of_documents.size() < 2) return;
  const YAML::Mark& second = beginnings.of_documents[1];
  const auto at = static_cast<std::size_t>(std::max(second.pos, 0));
  const bool comma = at < text.size() && text[at] == ',';
  fail_at(
      path, second.line + 1,
      comma ? "not valid YAML: a comma outside of all lists" : "a second document: expected one");
}

/// Files of OpenCV and of older ROS camera calibrators begin with "%YAML:1.0", which is no valid
/// YAML directive.
YAML::Node only_document(const std::string& text, const std::string& path) {
  const std::string yaml = (text.rfind("%YAML:", 0) == 0 ? "#" : "") + text;
  expect_one_document(yaml, path);
  return YAML::Load(yaml);
}

DataPtr load_file(const std::string& path, Reading& reading) {
  std::vector<std::string>& chain = reading.chain;
  if (++reading.files > kMostFiles) {
    fail_at(path, 1,
            "extends: more than " + std::to_string(kMostFiles) +
                " files in all; expected fewer, and none twice");
  }
  chain.push_back(std::filesystem::weakly_canonical(path).string());

  require_file(path);
  YAML::Node root;
  try {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw BadInput(path + ": cannot be read; expected a YAML file");
    root = only_document({std::istreambuf_iterator<char>(in), {}}, path);
  } catch (const YAML::Exception& e) {
    fail_at(path, e.mark.line + 1, "not valid YAML: " + e.msg);
  }
  auto file = std::make_shared<const std::string>(path);
  DataPtr data = convert(root, file, reading);
  if (data->kind != NodeKind::kMap)
    fail_at(path, 1, "expected a map of keys at the top of the file");

  if (const DataPtr extends = data->find("extends")) {
    auto& entries = data->entries;
    entries.erase(std::find_if(entries.begin(), entries.end(),
                               [](const auto& entry) { return entry.first == "extends"; }));
    const bool one = extends->kind == NodeKind::kScalar;
    DataPtr base;
    for (const DataPtr& name : one ? std::vector<DataPtr>{extends} : extends->items) {
      const std::string base_path = base_file(path, *name);
      const std::string canonical = std::filesystem::weakly_canonical(base_path).string();
      if (std::find(chain.begin(), chain.end(), canonical) != chain.end()) {
        fail_at(path, name->line, "extends: " + name->scalar + ": the file extends itself");
      }
      const DataPtr next = load_file(base_path, reading);
      base = base ? merge(base, next) : next;
    }
    if (!base) fail_at(path, extends->line, "extends: expected the name of a YAML file, or a list");
    data = merge(base, data);
  }
  chain.pop_back();
  return data;
}

void mark_read(const DataPtr& data) {
  data->read = true;
  for (const auto& item : data->items) mark_read(item);
  for (const auto& entry : data->entries) mark_read(entry.second);
}

DataPtr deep_copy(const DataPtr& data) {
  auto copy = std::make_shared<Data>(*data);
  for (auto& item : copy->items) item = deep_copy(item);
  for (auto& entry : copy->entries) entry.second = deep_copy(entry.second);
  return copy;
}

void emit(YAML::Emitter& out, const DataPtr& data, bool flow) {
  switch (data->kind) {
    case NodeKind::kNull:
      out << YAML::Null;
      break;
    case NodeKind::kScalar:
      out << data->scalar;
      break;
    case NodeKind::kSequence:
      if (flow || (!data->items.empty() && data->items.front()->kind == NodeKind::kScalar)) {
        out << YAML::Flow;
      }
      out << YAML::BeginSeq;
      for (const auto& item : data->items) emit(out, item, true);
      out << YAML::EndSeq;
      break;
    case NodeKind::kMap:
      if (flow) out << YAML::Flow;
      out << YAML::BeginMap;
      for (const auto& [key, value] : data->entries) {
        out << YAML::Key << key << YAML::Value;
        emit(out, value, flow);
      }
      out << YAML::EndMap;
      break;
  }
}

}  // namespace

bool Bounds::contains(double value) const {
  if (!std::isfinite(value)) return false;
  return (lo_open ? value > lo : value >= lo) && (hi_open ? value < hi : value <= hi);
}

std::string Bounds::text() const {
  const bool has_lo = std::isfinite(lo), has_hi = std::isfinite(hi);
  if (has_lo && has_hi) {
    return std::string("a number in ") + (lo_open ? "(" : "[") + significant(lo, 6) + ", " +
           significant(hi, 6) + (hi_open ? ")" : "]");
  }
  if (has_lo) return std::string("a number ") + (lo_open ? "> " : ">= ") + significant(lo, 6);
  if (has_hi) return std::string("a number ") + (hi_open ? "< " : "<= ") + significant(hi, 6);
  return "a finite number";
}

ConfigNode ConfigNode::load(const std::string& file) {
  Reading reading;
  return ConfigNode(load_file(file, reading), "");
}

ConfigNode ConfigNode::parse(const std::string& text, const std::string& name) {
  try {
    const YAML::Node root = only_document(text, name);
    Reading reading;
    return ConfigNode(convert(root, std::make_shared<const std::string>(name), reading), "");
  } catch (const YAML::Exception& e) {
    fail_at(name, e.mark.line + 1, "not valid YAML: " + e.msg);
  }
}

bool ConfigNode::is_map() const {
  return data_->kind == NodeKind::kMap;
}
bool ConfigNode::is_sequence() const {
  return data_->kind == NodeKind::kSequence;
}
bool ConfigNode::is_scalar() const {
  return data_->kind == NodeKind::kScalar;
}
bool ConfigNode::has(const std::string& key) const {
  // Otherwise a word or list here would be ignored silently: it has no keys that could be unknown.
  if (data_->kind == NodeKind::kScalar || data_->kind == NodeKind::kSequence)
    fail_expected("a map");
  const DataPtr child = data_->find(key);
  if (child && child->kind == NodeKind::kNull) child->read = true;
  return child && child->kind != NodeKind::kNull;
}

const std::string& ConfigNode::file() const {
  return *data_->file;
}

void ConfigNode::fail(const std::string& message) const {
  fail_at(*data_->file, data_->line, (path_.empty() ? "" : path_ + ": ") + message);
}

void ConfigNode::fail_expected(const std::string& expectation) const {
  const std::string value = data_->kind == NodeKind::kScalar ? data_->scalar
                            : data_->kind == NodeKind::kSequence
                                ? "a list of " + std::to_string(data_->items.size())
                            : data_->kind == NodeKind::kMap ? "{...}"
                                                            : "(empty)";
  fail(value + ": expected " + expectation);
}

ConfigNode ConfigNode::at(const std::string& key) const {
  if (data_->kind != NodeKind::kMap) fail_expected("a map with the key '" + key + "'");
  data_->read = true;
  const DataPtr child = data_->find(key);
  if (!child) fail("key '" + key + "' is missing");
  child->read = true;
  return ConfigNode(child, join(path_, key));
}

std::vector<ConfigNode> ConfigNode::items() const {
  if (data_->kind != NodeKind::kSequence) fail_expected("a list");
  data_->read = true;
  std::vector<ConfigNode> nodes;
  for (std::size_t i = 0; i < data_->items.size(); ++i) {
    data_->items[i]->read = true;
    nodes.push_back(ConfigNode(data_->items[i], join(path_, std::to_string(i))));
  }
  return nodes;
}

std::vector<std::pair<std::string, ConfigNode>> ConfigNode::entries() const {
  if (data_->kind != NodeKind::kMap) fail_expected("a map");
  data_->read = true;
  std::vector<std::pair<std::string, ConfigNode>> nodes;
  for (const auto& [key, value] : data_->entries) {
    value->read = true;
    nodes.emplace_back(key, ConfigNode(value, join(path_, key)));
  }
  return nodes;
}

double ConfigNode::as_number(const Bounds& bounds, const std::string& unit) const {
  const std::string expectation = bounds.text() + " [" + unit + "]";
  if (data_->kind != NodeKind::kScalar) fail_expected(expectation);
  data_->read = true;
  double value = 0.0;
  if (!YAML::convert<double>::decode(YAML::Node(data_->scalar), value) || !bounds.contains(value)) {
    fail_expected(expectation);
  }
  return value;
}

int ConfigNode::as_integer(int lo, int hi) const {
  const std::string expectation =
      "an integer from " + std::to_string(lo) + " to " + std::to_string(hi);
  if (data_->kind != NodeKind::kScalar) fail_expected(expectation);
  data_->read = true;
  int value = 0;
  // yaml-cpp takes a leading 0 for octal, as C does; whoever writes 010 means ten.
  const std::string& text = data_->scalar;
  if (text.size() > 1 && text[0] == '0' && std::isdigit(static_cast<unsigned char>(text[1]))) {
    fail_expected(expectation + ", without a leading 0");
  }
  if (!YAML::convert<int>::decode(YAML::Node(data_->scalar), value) || value < lo || value > hi) {
    fail_expected(expectation);
  }
  return value;
}

bool ConfigNode::as_bool() const {
  data_->read = true;
  bool value = false;
  if (data_->kind != NodeKind::kScalar ||
      !YAML::convert<bool>::decode(YAML::Node(data_->scalar), value)) {
    fail_expected("true or false");
  }
  return value;
}

std::string ConfigNode::as_text() const {
  if (data_->kind != NodeKind::kScalar || data_->scalar.empty()) fail_expected("a word");
  data_->read = true;
  return data_->scalar;
}

Eigen::Vector3d ConfigNode::as_vector3(const std::string& unit) const {
  if (data_->kind != NodeKind::kSequence || data_->items.size() != 3) {
    fail_expected("three numbers [x, y, z] [" + unit + "]");
  }
  const auto nodes = items();
  return {nodes[0].as_number(Bounds::any(), unit), nodes[1].as_number(Bounds::any(), unit),
          nodes[2].as_number(Bounds::any(), unit)};
}

std::vector<double> ConfigNode::as_numbers(std::size_t count, const std::string& unit) const {
  if (data_->kind != NodeKind::kSequence || data_->items.size() != count) {
    fail_expected(std::to_string(count) + " numbers [" + unit + "]");
  }
  std::vector<double> values;
  for (const ConfigNode& item : items()) values.push_back(item.as_number(Bounds::any(), unit));
  return values;
}

void ConfigNode::refuse_unknown_keys() const {
  for (const auto& [key, value] : data_->entries) {
    const ConfigNode child(value, join(path_, key));
    // A base's key may be wrong only for what a file that extends it has changed beside it.
    const bool changed = !path_.empty() && *value->file != *data_->file;
    if (!value->read) {
      child.fail("unknown key" +
                 (changed ? ", with what " + *data_->file + ":" + std::to_string(data_->line) +
                                " sets; there, '" + key + ": null' removes it"
                          : std::string()));
    }
    child.refuse_unknown_keys();
  }
  for (std::size_t i = 0; i < data_->items.size(); ++i) {
    ConfigNode(data_->items[i], join(path_, std::to_string(i))).refuse_unknown_keys();
  }
}

void ConfigNode::refuse_empty_values() const {
  for (const auto& [key, value] : data_->entries) {
    const ConfigNode child(value, join(path_, key));
    if (value->kind == NodeKind::kNull) child.fail_expected("a value; otherwise leave the key out");
    child.refuse_empty_values();
  }
  for (std::size_t i = 0; i < data_->items.size(); ++i) {
    ConfigNode(data_->items[i], join(path_, std::to_string(i))).refuse_empty_values();
  }
}

void ConfigNode::ignore() const {
  mark_read(data_);
}

void ConfigNode::set_number(const std::string& path, double value) {
  DataPtr data = data_;
  std::istringstream keys(path);
  std::string key;
  while (std::getline(keys, key, '.')) {
    DataPtr child;
    if (data->kind == NodeKind::kMap) {
      child = data->find(key);
    } else if (data->kind == NodeKind::kSequence && !key.empty() &&
               key.find_first_not_of("0123456789") == std::string::npos) {
      const std::size_t index = std::stoul(key);
      if (index < data->items.size()) child = data->items[index];
    }
    if (!child) fail(path + ": no such number in the model");
    data = child;
  }
  double old = 0.0;
  if (data->kind != NodeKind::kScalar ||
      !YAML::convert<double>::decode(YAML::Node(data->scalar), old)) {
    fail(path + ": not a number in the model");
  }
  std::ostringstream out;
  out.precision(17);
  out << value;
  data->scalar = out.str();
}

ConfigNode ConfigNode::clone() const {
  return ConfigNode(deep_copy(data_), path_);
}

std::string ConfigNode::to_yaml() const {
  YAML::Emitter out;
  emit(out, data_, false);
  return std::string(out.c_str()) + "\n";
}

}  // namespace anthrob
