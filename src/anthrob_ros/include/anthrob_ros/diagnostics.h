#pragma once

#include <diagnostic_msgs/KeyValue.h>

#include <cstdio>
#include <string>

namespace anthrob {

inline diagnostic_msgs::KeyValue key_value(const std::string& key, const std::string& value) {
  diagnostic_msgs::KeyValue kv;
  kv.key = key, kv.value = value;
  return kv;
}

/// Three digits after the point.
inline std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof(buffer), "%.3f", value);
  return buffer;
}

}  // namespace anthrob
