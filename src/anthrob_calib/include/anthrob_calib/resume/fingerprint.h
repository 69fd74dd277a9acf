#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "anthrob_sim/recording/dataset.h"

namespace anthrob {
namespace resume {

/// Bits of what a result depends on, in one number (FNV-1a, 64 bit).
class Fingerprint {
 public:
  Fingerprint& add(const void* bytes, std::size_t count);
  Fingerprint& add(double value) { return add(&value, sizeof(value)); }
  Fingerprint& add(std::uint64_t value) { return add(&value, sizeof(value)); }
  /// With its length, so that "ab", "c" is not "a", "bc".
  Fingerprint& add(const std::string& text);
  Fingerprint& add(const Dataset& recording);

  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 14695981039346656037ULL;
};

/// Of what a recording tells, however it is kept: the same for a bag, the folder it was converted
/// to and a copy with another meta.yaml, with times from its beginning on.
std::uint64_t content_fingerprint(const Dataset& recording);
/// Of the model file with all it extends, and of the files that it names.
std::uint64_t model_fingerprint(const ConfigNode& model);
/// Of this program and its libraries, as the linker marked them.
std::uint64_t program_fingerprint();
/// Of a program that has loaded more since. @param files by content; none: the program as it was
std::uint64_t program_fingerprint(std::uint64_t program, const std::vector<std::string>& files);

}  // namespace resume
}  // namespace anthrob
