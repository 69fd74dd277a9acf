#pragma once

#include <Eigen/Core>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace anthrob {

/// The allowed range of a number in a file, and its description for messages.
struct Bounds {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  bool lo_open = false;
  bool hi_open = false;

  static Bounds any() { return {}; }
  static Bounds positive() { return {0.0, std::numeric_limits<double>::infinity(), true, false}; }
  static Bounds nonnegative() { return {0.0}; }
  static Bounds between(double lo, double hi) { return {lo, hi}; }
  /// (0, 1]
  static Bounds fraction() { return {0.0, 1.0, true, false}; }

  bool contains(double value) const;
  std::string text() const;
};

/// A strict view of a YAML file. Every value knows its file, line and key path. Keys that the
/// program never reads are errors (refuse_unknown_keys). `extends: OTHER.yaml` is already merged:
/// maps key by key, everything else is replaced. A first line "%YAML:1.0", as OpenCV writes it, is
/// ignored. All errors are BadInput with one line, "FILE:LINE: KEY: VALUE: expected ...".
class ConfigNode {
 public:
  /// @throws BadInput if a file is missing, is not YAML, repeats a key, or extends itself
  static ConfigNode load(const std::string& file);
  /// For text that is not in a file; `name` stands for the file in messages.
  static ConfigNode parse(const std::string& text, const std::string& name);

  bool is_map() const;
  bool is_sequence() const;
  bool is_scalar() const;
  /// Whether a map has the key. A key with an empty value or null counts as absent: in this way a
  /// file removes a key of the file that it extends.
  /// @throws BadInput if this is a word, a number or a list
  bool has(const std::string& key) const;

  /// A required member of a map.
  ConfigNode at(const std::string& key) const;
  std::vector<ConfigNode> items() const;                            ///< of a sequence
  std::vector<std::pair<std::string, ConfigNode>> entries() const;  ///< of a map, in file order

  double as_number(const Bounds& bounds, const std::string& unit) const;
  int as_integer(int lo, int hi) const;
  bool as_bool() const;
  std::string as_text() const;
  Eigen::Vector3d as_vector3(const std::string& unit) const;
  /// A list of exactly so many numbers.
  std::vector<double> as_numbers(std::size_t count, const std::string& unit) const;

  double number(const std::string& key, const Bounds& bounds, const std::string& unit) const {
    return at(key).as_number(bounds, unit);
  }
  double number_or(const std::string& key, double fallback, const Bounds& bounds,
                   const std::string& unit) const {
    return has(key) ? number(key, bounds, unit) : fallback;
  }
  std::string text(const std::string& key) const { return at(key).as_text(); }
  std::string text_or(const std::string& key, const std::string& fallback) const {
    return has(key) ? text(key) : fallback;
  }

  /// Refuses keys of this map, at any depth below it, that were never read.
  void refuse_unknown_keys() const;

  /// Refuses keys without a value, at any depth below this node: for files in which such a key is a
  /// mistake. Elsewhere it counts as absent (has()).
  void refuse_empty_values() const;

  /// Marks the whole subtree as read; for parts that another program reads.
  void ignore() const;

  /// Sets an existing number; "muscles.biceps_brachii.path.2.point.0".
  /// @throws BadInput if there is no number at that path
  void set_number(const std::string& path, double value);

  /// @throws BadInput always: "FILE:LINE: KEY: message"
  [[noreturn]] void fail(const std::string& message) const;
  /// @throws BadInput always: "FILE:LINE: KEY: VALUE: expected ..."
  [[noreturn]] void fail_expected(const std::string& expectation) const;

  const std::string& file() const;
  const std::string& path() const { return path_; }

  /// A copy that shares nothing with this tree.
  ConfigNode clone() const;
  /// The merged tree as YAML text.
  std::string to_yaml() const;

  struct Data;

 private:
  ConfigNode(std::shared_ptr<Data> data, std::string path)
      : data_(std::move(data)), path_(std::move(path)) {}

  std::shared_ptr<Data> data_;
  std::string path_;
};

/// Canonical paths of a YAML file and of all files that it extends.
/// @param file one that ConfigNode::load() accepts
/// @throws BadInput if a file is missing or is not YAML
std::vector<std::string> extended_files(const std::string& file);

}  // namespace anthrob
