#include "effects/trusted_libraries.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace anthrob {

namespace {

namespace fs = std::filesystem;

/// Links are followed: what they lead to is what runs.
bool is_below(const fs::path& file, const fs::path& folder) {
  const fs::path real = fs::weakly_canonical(file), top = fs::weakly_canonical(folder);
  return std::mismatch(top.begin(), top.end(), real.begin(), real.end()).first == top.end();
}

}  // namespace

bool is_trusted(const std::string& name, const std::string& file, const std::string& trusted) {
  std::istringstream list(trusted);
  for (std::string entry; std::getline(list, entry, ':');) {
    if (entry.empty()) continue;
    if (entry == name || entry == file) return true;
    const bool both_are_paths =
        entry.find('/') != std::string::npos && file.find('/') != std::string::npos;
    while (entry.size() > 1 && entry.back() == '/') entry.pop_back();
    if (both_are_paths && is_below(file, entry)) return true;
  }
  return false;
}

}  // namespace anthrob
