#include "tool.h"

#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "anthrob_mocap/core/errors.h"

namespace anthrob {
namespace mocap {
namespace tool {

namespace {

volatile std::sig_atomic_t interrupt_seen = 0;

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (char& c : text) {
    if (c == '\n') c = ' ';
  }
  return text;
}

}  // namespace

int run(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  const auto say = [&](const char* what) { std::cerr << app.get_name() << ": " << one_line(what); };
  try {
    app.parse(argc, argv);
    return body();
  } catch (const CLI::Success& e) {
    app.exit(e);
    return kDone;
  } catch (const CLI::ParseError& e) {
    say(e.what());
    std::cerr << " (--help explains)\n";
    return kBadInput;
  } catch (const BadInput& e) {
    say(e.what());
    std::cerr << "\n";
    return kBadInput;
  } catch (const std::exception& e) {
    say(e.what());
    std::cerr << "\n";
    return kFailed;
  }
}

NewFile::NewFile(const std::string& name)
    : name_(name), part_(name + ".part" + std::to_string(getpid())), out_(part_) {
  if (!out_) fail();
}

NewFile::~NewFile() {
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void NewFile::close() {
  out_.close();
  if (!out_) fail();
}

void NewFile::put_in_place() {
  std::error_code error;
  std::filesystem::rename(part_, name_, error);
  if (error) fail();
}

void NewFile::fail() const {
  throw std::runtime_error(name_ + ": cannot be written");
}

bool interrupted() {
  static const bool kListening = [] {
    std::signal(SIGINT, [](int) { interrupt_seen = 1; });
    std::signal(SIGTERM, [](int) { interrupt_seen = 1; });
    return true;
  }();
  return kListening && interrupt_seen != 0;
}

}  // namespace tool
}  // namespace mocap
}  // namespace anthrob
