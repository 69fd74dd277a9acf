#pragma once

#include <string>

namespace anthrob {

/// Whether a name from a user's file can be used in topics, columns and diagnostics.
inline bool is_snake_case(const std::string& name) {
  bool good = !name.empty() && name[0] >= 'a' && name[0] <= 'z';
  for (const char c : name)
    good = good && ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_');
  return good;
}

}  // namespace anthrob
