#include "anthrob_core/text.h"

#include <cmath>
#include <cstdio>

namespace anthrob {

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

void append(const std::vector<std::string>& more, std::vector<std::string>& words) {
  words.insert(words.end(), more.begin(), more.end());
}

std::string trimmed(const std::string& text, const char* blank) {
  const std::size_t first = text.find_first_not_of(blank), end = text.find_last_not_of(blank) + 1;
  return first < end ? text.substr(first, end - first) : std::string();
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else
      out += c;
  }
  return out;
}

std::string significant(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.*g", digits, value);
  return text;
}

std::string short_number(double value) {
  if (!std::isfinite(value)) return "unlimited";
  const double size = std::abs(value);
  const bool is_whole = size >= 999.5 && size < 1e7;  // rather than 1.04e+03
  if (!is_whole) return significant(value, 3);
  char text[32];
  std::snprintf(text, sizeof(text), "%.0f", value);
  return text;
}

std::string duration_text(double seconds) {
  if (seconds < 120.0) return short_number(seconds) + " s";
  if (seconds < 7200.0) return short_number(std::round(seconds / 60.0)) + " min";
  return short_number(seconds / 3600.0) + " h";
}

}  // namespace anthrob
