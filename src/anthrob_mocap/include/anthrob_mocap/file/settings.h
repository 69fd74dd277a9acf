#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "anthrob_mocap/core/types.h"

namespace anthrob {
namespace mocap {

/// A strict view of a YAML file: every value knows its file, line and key, every key must be asked
/// for. All errors are BadInput with one line, "FILE:LINE: KEY: VALUE: expected ...".
class Settings {
 public:
  /// @throws BadInput if the file is missing, is not YAML, or repeats a key
  static Settings load(const std::string& file);
  /// For text that is not in a file; `name` stands for the file in messages.
  static Settings parse(const std::string& text, const std::string& name);

  bool has(const std::string& key) const;
  Settings at(const std::string& key) const;  ///< a required member of a map
  std::vector<Settings> items() const;        ///< of a sequence
  std::vector<std::string> keys() const;      ///< of a map, in file order

  double number(double lo, double hi, const std::string& unit = "") const;
  int integer(int lo, int hi) const;
  std::string text() const;
  std::vector<double> numbers(std::size_t count) const;
  Vec3 vector3() const;
  Quat unit_quaternion() const;  ///< [w, x, y, z]

  double number_or(const std::string& key, double fallback, double lo, double hi) const {
    return has(key) ? at(key).number(lo, hi) : fallback;
  }

  /// Refuses keys of this map, at any depth, that nobody asked for.
  void refuse_unknown_keys() const;

  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void fail_expected(const std::string& expectation) const;
  const std::string& path() const { return path_; }

  struct Data;

 private:
  Settings(std::shared_ptr<Data> data, std::string path);

  std::shared_ptr<Data> data_;
  std::string path_;
};

}  // namespace mocap
}  // namespace anthrob
