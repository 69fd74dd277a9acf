#include "anthrob_core/progress_lines.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>

namespace anthrob {
namespace tool {
namespace progress_lines {

namespace {

/// The descriptor that was asked for, if it is one.
std::optional<int> given_descriptor() {
  const char* const text = std::getenv(kVariable);
  if (text == nullptr) return std::nullopt;
  int descriptor = 0;
  const char* const end = text + std::strlen(text);
  const auto read = std::from_chars(text, end, descriptor);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  // What this program starts does not speak for it.
  unsetenv(kVariable);
  if (fcntl(descriptor, F_SETFD, FD_CLOEXEC) != 0) return std::nullopt;
  // Who reads may end first.
  std::signal(SIGPIPE, SIG_IGN);
  return descriptor;
}

// Before main(): later, another file may have that number.
const std::optional<int> descriptor = given_descriptor();

void write_line(const std::string& line) {
  static std::mutex one_at_a_time;
  if (!descriptor) return;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  std::size_t written = 0;
  while (written < line.size()) {
    const ssize_t count = write(*descriptor, line.data() + written, line.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;  // nobody reads any more
    written += static_cast<std::size_t>(count);
  }
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      char code[8];
      std::snprintf(code, sizeof(code), "\\u%04x", static_cast<unsigned>(c));
      out += code;
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return std::isfinite(value) ? text : "null";
}

void write_text(const char* key, const std::string& text) {
  write_line(std::string("{\"") + key + "\": " + quoted(text) + "}\n");
}

}  // namespace

void stage(const std::string& what) {
  write_text("stage", what);
}

void share(double share, std::optional<double> seconds_left) {
  write_line("{\"share\": " + number(share) +
             ", \"seconds_left\": " + (seconds_left ? number(*seconds_left) : "null") + "}\n");
}

void best(const std::string& what) {
  write_text("best", what);
}

void headline(const std::string& line) {
  write_text("headline", line);
}

void error(const std::string& line) {
  write_text("error", line);
}

}  // namespace progress_lines
}  // namespace tool
}  // namespace anthrob
