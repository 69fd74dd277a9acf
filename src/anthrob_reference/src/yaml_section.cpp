#include "yaml_section.h"

#include <cmath>
#include <stdexcept>

namespace anthrob::reference {

YamlSection::YamlSection(const YAML::Node& node, const std::string& where)
    : node_(node), where_(where) {
  if (!node_.IsMap()) throw std::runtime_error(where_ + ": expected a map");
}

bool YamlSection::has(const std::string& key) const {
  const YAML::Node found = node_[key];  // a const node is not extended by looking
  return found.IsDefined();
}

double YamlSection::number(const std::string& key) {
  const auto result = value<double>(key);
  if (!std::isfinite(result)) fail(key, "expected a finite number");
  return result;
}

int YamlSection::integer(const std::string& key) {
  return value<int>(key);
}

std::string YamlSection::text(const std::string& key) {
  return value<std::string>(key);
}

Eigen::Vector3d YamlSection::vector(const std::string& key) {
  const YAML::Node found = list(key);
  if (found.size() != 3) fail(key, "expected three numbers");
  Eigen::Vector3d result;
  for (int i = 0; i < 3; ++i) {
    try {
      result(i) = found[i].as<double>();
    } catch (const YAML::Exception&) {
      fail(key, "expected three numbers");
    }
  }
  return result;
}

YamlSection YamlSection::section(const std::string& key) {
  if (!has(key)) fail(key, "missing");
  used_.insert(key);
  return {node_[key], where_ + "/" + key};
}

YAML::Node YamlSection::list(const std::string& key) {
  if (!has(key)) fail(key, "missing");
  used_.insert(key);
  if (!node_[key].IsSequence()) fail(key, "expected a list");
  return node_[key];
}

void YamlSection::expect(const std::string& key, const std::string& word) {
  const std::string found = text(key);
  if (found != word) fail(key, found + ": not modelled; expected " + word);
}

void YamlSection::finish() const {
  for (const auto& entry : node_) {
    const auto key = entry.first.as<std::string>();
    if (used_.count(key) == 0) fail(key, "unknown key");
  }
}

void YamlSection::fail(const std::string& key, const std::string& reason) const {
  throw std::runtime_error(where_ + "/" + key + ": " + reason);
}

template <typename T>
T YamlSection::value(const std::string& key) {
  if (!has(key)) fail(key, "missing");
  used_.insert(key);
  try {
    return node_[key].as<T>();
  } catch (const YAML::Exception& error) {
    fail(key, error.msg);
  }
}

}  // namespace anthrob::reference
