#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <set>
#include <string>

namespace anthrob::reference {

/// One map of a model file, read key by key. finish() refuses keys that were not read, so that a
/// misspelt or unsupported key does not go unnoticed. Errors (std::runtime_error) name the place.
class YamlSection final {
 public:
  YamlSection(const YAML::Node& node, const std::string& where);

  bool has(const std::string& key) const;
  double number(const std::string& key);
  int integer(const std::string& key);
  std::string text(const std::string& key);
  Eigen::Vector3d vector(const std::string& key);
  YamlSection section(const std::string& key);
  YAML::Node list(const std::string& key);
  /// Accepts a key that this model does not use; it may be absent.
  void ignore(const std::string& key) { used_.insert(key); }
  /// @throws std::runtime_error unless the value of the key is this word.
  void expect(const std::string& key, const std::string& word);
  void finish() const;

  const YAML::Node& node() const { return node_; }
  const std::string& where() const { return where_; }
  [[noreturn]] void fail(const std::string& key, const std::string& reason) const;

 private:
  template <typename T>
  T value(const std::string& key);

  YAML::Node node_;
  std::string where_;
  std::set<std::string> used_;
};

}  // namespace anthrob::reference
