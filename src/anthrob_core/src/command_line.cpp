#include "anthrob_core/command_line.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "anthrob_core/errors.h"
#include "anthrob_core/monotonic_clock.h"
#include "anthrob_core/progress_lines.h"
#include "anthrob_core/robots.h"
#include "anthrob_core/signals.h"
#include "anthrob_core/version.h"

namespace anthrob {
namespace tool {

namespace {

volatile std::sig_atomic_t listening = 0, interrupt_seen = 0;

/// A stop is often said twice at once: timeout signals the program, then its group; a terminal that
/// is closed does so through its shell and by itself. Nobody presses Ctrl-C twice within that.
constexpr double kSaidTwice = 0.5;  // [s]
std::atomic<double> first_heard{0.0};
static_assert(std::atomic<double>::is_always_lock_free, "used by a signal handler");

constexpr double kRefreshed = 0.2;  // [s] between two lines of progress: as fast as one reads

/// Ends a program that does not come to look.
void on_repeated_interrupt(int) {
  if (monotonic_now() - first_heard > kSaidTwice) _exit(kInterrupted);
}

void on_interrupt(int number) {
  interrupt_seen = 1;
  first_heard = monotonic_now();
  std::signal(number, on_repeated_interrupt);
}

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (char& c : text) {
    if (c == '\n') c = ' ';
  }
  return text;
}

/// @return status
int failed(const CLI::App& app, const std::string& why, Exit status) {
  const std::string line = app.get_name() + ": " + why;
  std::cerr << line << "\n";
  progress_lines::error(line);
  return status;
}

/// What roslaunch adds to a command line: "__name:=discover", "__log:=..."
bool is_remapping(const std::string& argument) {
  return argument.rfind("__", 0) == 0 && argument.find(":=") != std::string::npos;
}

/// [s] None: it has just begun, or takes longer than was reckoned.
std::optional<double> seconds_left(double share, double elapsed) {
  if (share > 0.0 && share < 1.0) return elapsed * (1.0 - share) / share;
  return std::nullopt;
}

/// Whether all of a text is one finite number.
bool read_number(const std::string& text, double& value) {
  std::size_t used = 0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    return false;
  }
  return used == text.size() && std::isfinite(value);
}

}  // namespace

int run(CLI::App& app, int argc, char** argv, const std::function<int()>& body, int stopped) {
  if (listening == 0) leave_when_stopped(stopped);
  app.set_version_flag("--version", version_of(app.get_name()), "print the version and end");
  std::vector<char*> arguments;
  std::copy_if(argv, argv + argc, std::back_inserter(arguments),
               [](const char* argument) { return !is_remapping(argument); });
  try {
    app.parse(static_cast<int>(arguments.size()), arguments.data());
    const int status = body();
    if (status != kDone) return status;
    // What a full disk has cut off is no answer.
    if (!std::cout.flush() || std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      return failed(app, "standard output: cannot be written", kFailed);
    }
    return status;
  } catch (const CLI::Success& e) {
    app.exit(e);
    return kDone;
  } catch (const CLI::ParseError& e) {
    return failed(app, one_line(e.what()) + " (see --help)", kBadInput);
  } catch (const BadInput& e) {
    return failed(app, e.what(), kBadInput);
  } catch (const std::exception& e) {
    return failed(app, one_line(e.what()), kFailed);
  }
}

CLI::Validator within(double lowest, double highest) {
  std::ostringstream range;
  range << "a number from " << lowest << " to " << highest;
  const auto check = [lowest, highest, range = range.str()](std::string& text) -> std::string {
    double value = 0.0;
    const bool number = CLI::detail::lexical_cast(text, value);
    if (number && value >= lowest && value <= highest) return "";
    return text + ": expected " + range;
  };
  return CLI::Validator(check, range.str());
}

CLI::Validator model_or_file() {
  CLI::Validator named("FILE, or a name such as anthrob/II");
  return named.operation([](std::string& text) {
    text = find_model_file(text);
    return std::string();  // nothing to complain of
  });
}

bool interrupted() {
  if (listening == 0) {
    listening = 1;
    anthrob::on_stop(on_interrupt);
  }
  return interrupt_seen != 0;
}

void say(const CLI::App& app, const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) std::cerr << app.get_name() << ": " << remark << "\n";
}

Assignment parse_assignment(const std::string& option, const std::string& text) {
  const auto fail = [&] {
    throw BadInput(option + " " + text + ": expected NAME=NUMBER or NAME=NUMBER,NUMBER,...");
  };
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) fail();
  Assignment assignment{text.substr(0, equals), {}};
  std::istringstream values(text.substr(equals + 1));
  std::string value;
  while (std::getline(values, value, ',')) {
    assignment.values.emplace_back();
    if (!read_number(value, assignment.values.back())) fail();
  }
  if (assignment.values.empty()) fail();
  return assignment;
}

Range parse_range(const std::string& option, const std::string& text) {
  const auto fail = [&](const std::string& expected) {
    throw BadInput(option + " " + text + ": expected " + expected);
  };
  const auto equals = text.find('=');
  const auto first = text.find(':', equals == std::string::npos ? 0 : equals),
             second = first == std::string::npos ? first : text.find(':', first + 1);
  Range range;
  const bool split = equals != std::string::npos && equals > 0 && second != std::string::npos;
  if (!split || !read_number(text.substr(equals + 1, first - equals - 1), range.from) ||
      !read_number(text.substr(first + 1, second - first - 1), range.to)) {
    fail("NAME=FROM:TO:POINTS");
  }
  range.name = text.substr(0, equals);
  const char* end = text.data() + text.size();
  const auto points = std::from_chars(text.data() + second + 1, end, range.points);
  if (points.ec != std::errc() || points.ptr != end || range.points < 2 ||
      range.points > kMostPoints) {
    fail("a whole number of POINTS from 2 to " + std::to_string(kMostPoints));
  }
  return range;
}

Progress::Progress(const std::string& what)
    : what_(what), start_(monotonic_now()), visible_(isatty(2) == 1) {}

Progress::~Progress() {
  if (visible_) std::fprintf(stderr, "\r\033[K");
}

void Progress::update(double share) {
  const double t = monotonic_now();
  if (t - last_ < kRefreshed) return;
  const double past = elapsed();
  progress_lines::share(share, seconds_left(share, past));
  show(progress_text(share, past));
  last_ = t;
}

void Progress::show(const std::string& state) {
  const double t = monotonic_now();
  if (!visible_ || t - last_ < kRefreshed) return;
  last_ = t;
  std::fprintf(stderr, "\r\033[K%s: %s", what_.c_str(), state.c_str());
}

double Progress::elapsed() const {
  return monotonic_now() - start_;
}

std::string progress_text(double share, double elapsed) {
  char text[80];
  if (const auto left = seconds_left(share, elapsed)) {
    std::snprintf(text, sizeof(text), "%3.0f %%, %.0f s left", 100.0 * share, *left);
  } else {
    std::snprintf(text, sizeof(text), "%3.0f %%, %.0f s so far", 100.0 * share, elapsed);
  }
  return text;
}

}  // namespace tool
}  // namespace anthrob
