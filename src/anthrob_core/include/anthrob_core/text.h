#pragma once

#include <string>
#include <vector>

namespace anthrob {

/// Whether a name from a user's file can be used in topics, columns and diagnostics.
inline bool is_snake_case(const std::string& name) {
  bool good = !name.empty() && name[0] >= 'a' && name[0] <= 'z';
  for (const char c : name)
    good = good && ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_');
  return good;
}

/// "a, b, c"
std::string joined(const std::vector<std::string>& words, const std::string& separator = ", ");

/// Adds words, or lines, at the end of others.
void append(const std::vector<std::string>& more, std::vector<std::string>& words);

/// Without the given characters at its beginning and end.
std::string trimmed(const std::string& text, const char* blank = " \t\r");

/// As text of an HTML or SVG page, whatever it holds.
std::string escaped(const std::string& text);

/// With so many significant digits: "0.0421".
std::string significant(double value, int digits);

/// "0.0421", three significant digits, or all before the point if there are more: "26123".
std::string short_number(double value);

/// "95 s", "17 min", "3.2 h"
std::string duration_text(double seconds);

}  // namespace anthrob
