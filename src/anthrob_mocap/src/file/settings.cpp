#include "anthrob_mocap/file/settings.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "anthrob_config/errors.h"

namespace anthrob {
namespace mocap {

struct Settings::Data {
  YAML::Node node;
  std::string file;
  std::shared_ptr<std::set<std::string>> read;  ///< paths that somebody asked for
};

namespace {

std::string join(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::string shown(const YAML::Node& node) {
  if (node.IsScalar()) return node.Scalar();
  if (node.IsSequence()) return "a list of " + std::to_string(node.size());
  if (node.IsMap()) return "a map";
  return "nothing";
}

std::string format(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

/// yaml-cpp takes the last of repeated keys; here a repetition is a mistake.
void refuse_repeated_keys(const YAML::Node& node, const std::string& file) {
  if (node.IsMap()) {
    std::set<std::string> seen;
    for (const auto& entry : node) {
      if (!entry.first.IsScalar() || !seen.insert(entry.first.Scalar()).second) {
        throw BadInput(file + ":" + std::to_string(entry.first.Mark().line + 1) + ": " +
                       shown(entry.first) + ": expected a key that is a word and appears once");
      }
    }
  }
  if (node.IsMap())
    for (const auto& entry : node) refuse_repeated_keys(entry.second, file);
  if (node.IsSequence())
    for (const auto& item : node) refuse_repeated_keys(item, file);
}

}  // namespace

Settings::Settings(std::shared_ptr<Data> data, std::string path)
    : data_(std::move(data)), path_(std::move(path)) {}

Settings Settings::load(const std::string& file) {
  if (std::filesystem::is_directory(file)) throw BadInput(file + ": expected a file, not a folder");
  std::ifstream in(file);
  if (!in) throw BadInput(file + ": cannot be read");
  std::ostringstream text;
  text << in.rdbuf();
  return parse(text.str(), file);
}

Settings Settings::parse(const std::string& text, const std::string& name) {
  try {
    // Files of OpenCV and of older ROS calibrators begin "%YAML:1.0", which is not YAML.
    const bool odd_header = text.rfind("%YAML:", 0) == 0;
    const std::vector<YAML::Node> documents = YAML::LoadAll(odd_header ? "#" + text : text);
    if (documents.size() > 1) {
      throw BadInput(name + ":" + std::to_string(documents[1].Mark().line + 1) +
                     ": a second YAML document: expected only one");
    }
    const YAML::Node node = documents.empty() ? YAML::Node() : documents.front();
    refuse_repeated_keys(node, name);
    if (!node.IsMap()) throw BadInput(name + ":1: " + shown(node) + ": expected a map");
    return Settings(
        std::make_shared<Data>(Data{node, name, std::make_shared<std::set<std::string>>()}), "");
  } catch (const YAML::Exception& error) {
    throw BadInput(name + ":" + std::to_string(error.mark.line + 1) + ": " + error.msg);
  }
}

void Settings::fail(const std::string& message) const {
  const int line = data_->node.Mark().line;
  throw BadInput(data_->file + ":" + std::to_string(line < 0 ? 1 : line + 1) + ": " +
                 (path_.empty() ? "" : path_ + ": ") + message);
}

void Settings::fail_expected(const std::string& expectation) const {
  fail(shown(data_->node) + ": expected " + expectation);
}

bool Settings::has(const std::string& key) const {
  const YAML::Node& node = data_->node;
  if (!node.IsMap() || !node[key].IsDefined()) return false;
  data_->read->insert(join(path_, key));  // known, even if it has no value
  return !node[key].IsNull();
}

Settings Settings::at(const std::string& key) const {
  if (!data_->node.IsMap()) fail_expected("a map with '" + key + "'");
  if (!has(key)) fail("'" + key + "': missing");
  const std::string path = join(path_, key);
  data_->read->insert(path);
  const YAML::Node& map = data_->node;
  return Settings(std::make_shared<Data>(Data{map[key], data_->file, data_->read}), path);
}

std::vector<Settings> Settings::items() const {
  if (!data_->node.IsSequence()) fail_expected("a list");
  std::vector<Settings> result;
  for (const auto& item : data_->node) {
    const std::string path = join(path_, std::to_string(result.size()));
    data_->read->insert(path);
    result.push_back(Settings(std::make_shared<Data>(Data{item, data_->file, data_->read}), path));
  }
  return result;
}

std::vector<std::string> Settings::keys() const {
  if (!data_->node.IsMap()) fail_expected("a map");
  std::vector<std::string> result;
  for (const auto& entry : data_->node) result.push_back(entry.first.Scalar());
  return result;
}

double Settings::number(double lo, double hi, const std::string& unit) const {
  double value = 0.0;
  const bool good = data_->node.IsScalar() && YAML::convert<double>::decode(data_->node, value) &&
                    std::isfinite(value) && value >= lo && value <= hi;
  if (good) return value;
  std::string range = "a number";
  if (std::isfinite(lo) && std::isfinite(hi)) {
    range += " between " + format(lo) + " and " + format(hi);
  } else if (std::isfinite(lo)) {
    range += " >= " + format(lo);
  }
  fail_expected(range + (unit.empty() ? "" : " [" + unit + "]"));
}

int Settings::integer(int lo, int hi) const {
  const double value = number(lo, hi);
  if (value != std::floor(value)) fail_expected("a whole number");
  return static_cast<int>(value);
}

std::string Settings::text() const {
  if (!data_->node.IsScalar() || data_->node.Scalar().empty()) fail_expected("a word");
  return data_->node.Scalar();
}

std::vector<double> Settings::numbers(std::size_t count) const {
  const std::vector<Settings> list = items();
  if (list.size() != count) fail_expected(std::to_string(count) + " numbers");
  std::vector<double> values;
  const double inf = std::numeric_limits<double>::infinity();
  for (const Settings& item : list) values.push_back(item.number(-inf, inf));
  return values;
}

Vec3 Settings::vector3() const {
  const std::vector<double> v = numbers(3);
  return {v[0], v[1], v[2]};
}

Quat Settings::unit_quaternion() const {
  const std::vector<double> v = numbers(4);
  const Quat q(v[0], v[1], v[2], v[3]);
  if (std::abs(q.norm() - 1.0) > 1e-3) fail_expected("a unit quaternion [w, x, y, z]");
  return q.normalized();
}

void Settings::refuse_unknown_keys() const {
  const YAML::Node& node = data_->node;
  if (node.IsMap()) {
    for (const auto& entry : node) {
      const std::string path = join(path_, entry.first.Scalar());
      if (data_->read->count(path) == 0) {
        throw BadInput(data_->file + ":" + std::to_string(entry.first.Mark().line + 1) + ": " +
                       path + ": unknown key");
      }
      if (entry.second.IsNull()) {
        throw BadInput(data_->file + ":" + std::to_string(entry.first.Mark().line + 1) + ": " +
                       path + ": nothing: expected a value; otherwise leave the key out");
      }
      at(entry.first.Scalar()).refuse_unknown_keys();
    }
  } else if (node.IsSequence()) {
    for (const Settings& item : items()) item.refuse_unknown_keys();
  }
}

}  // namespace mocap
}  // namespace anthrob
