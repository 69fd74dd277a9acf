#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "anthrob_core/config_node.h"
#include "anthrob_recording/dataset.h"

namespace anthrob {
namespace resume {

/// Hash of everything that a result depends on (FNV-1a, 64 bit).
class Fingerprint {
 public:
  Fingerprint& add(const void* bytes, std::size_t count);
  Fingerprint& add(double value) { return add(&value, sizeof(value)); }
  Fingerprint& add(std::uint64_t value) { return add(&value, sizeof(value)); }
  /// Includes the length, so that "ab", "c" differs from "a", "bc".
  Fingerprint& add(const std::string& text);
  Fingerprint& add(const Dataset& recording);

  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 14695981039346656037ULL;
};

/// Sixteen hexadecimal digits.
std::string fingerprint_text(std::uint64_t fingerprint);
/// Fingerprint of the samples of a recording, with times counted from its beginning. It is the same
/// for a bag, the folder that it was converted to, and a copy with another meta.yaml.
std::uint64_t content_fingerprint(const Dataset& recording);
/// Fingerprint of a model file with all that it extends, and of the files that it names.
std::uint64_t model_fingerprint(const ConfigNode& model);
/// Fingerprint of this program and its libraries, from the build ids of the linker.
std::uint64_t program_fingerprint();
/// Fingerprint of a program that has loaded more libraries since.
/// @param files those libraries, by content; if there are none, returns `program`
std::uint64_t program_fingerprint(std::uint64_t program, const std::vector<std::string>& files);

}  // namespace resume
}  // namespace anthrob
