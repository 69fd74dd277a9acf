#include "anthrob_config/command_line.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "anthrob_config/errors.h"

namespace anthrob {
namespace tool {

namespace {

volatile std::sig_atomic_t interrupt_seen = 0;

/// The second one of its kind ends a program that does not come to look.
void on_interrupt(int number) {
  interrupt_seen = 1;
  std::signal(number, SIG_DFL);
}

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (char& c : text) {
    if (c == '\n') c = ' ';
  }
  return text;
}

/// What roslaunch adds to a command line: "__name:=discover", "__log:=..."
bool is_remapping(const std::string& argument) {
  return argument.rfind("__", 0) == 0 && argument.find(":=") != std::string::npos;
}

}  // namespace

int run(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  std::vector<char*> arguments;
  std::copy_if(argv, argv + argc, std::back_inserter(arguments),
               [](const char* argument) { return !is_remapping(argument); });
  try {
    app.parse(static_cast<int>(arguments.size()), arguments.data());
    const int status = body();
    // What a full disk has cut off is no answer.
    if (!std::cout.flush() || std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      std::cerr << app.get_name() << ": standard output: cannot be written\n";
      return kFailed;
    }
    return status;
  } catch (const CLI::Success& e) {
    app.exit(e);
    return kDone;
  } catch (const CLI::ParseError& e) {
    std::cerr << app.get_name() << ": " << one_line(e.what()) << " (see --help)\n";
    return kBadInput;
  } catch (const BadInput& e) {
    std::cerr << app.get_name() << ": " << e.what() << "\n";
    return kBadInput;
  } catch (const std::exception& e) {
    std::cerr << app.get_name() << ": " << one_line(e.what()) << "\n";
    return kFailed;
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

bool interrupted() {
  static const bool kListening = [] {
    for (const int number : {SIGINT, SIGTERM}) std::signal(number, on_interrupt);
    return true;
  }();
  return kListening && interrupt_seen != 0;
}

}  // namespace tool
}  // namespace anthrob
