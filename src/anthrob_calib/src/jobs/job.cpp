#include "jobs/job.h"

#include <csignal>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "anthrob_core/command_line.h"
#include "anthrob_core/programs.h"
#include "anthrob_core/text.h"

namespace anthrob {
namespace jobs {

namespace {

namespace fs = std::filesystem;

/// What people look at, of whichever program.
constexpr const char* kFiles[] = {"report.html", "model.yaml", "result.json",  "report.json",
                                  "health.html", "health.csv", "pipeline.json"};

/// As one types it into a shell.
std::string typed(const std::vector<std::string>& words) {
  std::string line = "$";
  for (const std::string& word : words) {
    const bool plain =
        !word.empty() && word.find_first_of(" \t\n'\"\\$&|;<>()*?[]{}~#!`") == std::string::npos;
    std::string quoted;
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += " " + (plain ? word : "'" + quoted + "'");
  }
  return line;
}

/// Makes the folder, and tells in the log what is run.
/// @return size of the log then
std::uintmax_t begin_log(const std::string& out, const std::string& log,
                         const std::vector<std::string>& words) {
  std::error_code error;
  fs::create_directories(out, error);
  if (error) throw std::runtime_error(out + ": cannot be made: " + error.message());
  std::ofstream file(log, std::ios::app);
  file << typed(words) << "\n";
  // A full disk is for the program to tell.
  file.flush();
  const std::uintmax_t size = fs::file_size(log, error);
  if (error) throw std::runtime_error(log + ": cannot be written: " + error.message());
  return size;
}

std::vector<std::string> words_of(const JobCommand& command) {
  std::vector<std::string> words = {program_of_package(command.package, command.program)};
  words.insert(words.end(), command.arguments.begin(), command.arguments.end());
  return words;
}

std::string log_of(const JobCommand& command) {
  return (fs::path(command.out) / (command.program + ".log")).string();
}

}  // namespace

Job::Job(const JobCommand& command)
    : out_(command.out),
      log_(log_of(command)),
      before_(written()),
      log_begin_(begin_log(out_, log_, words_of(command))),
      process_(words_of(command), log_, !command.commands_robot),
      commands_robot_(command.commands_robot) {}

Job::Times Job::written() const {
  Times times;
  for (const char* name : kFiles) {
    const fs::path file = fs::path(out_) / name;
    std::error_code error;
    const auto time = fs::last_write_time(file, error);
    if (!error) times[file.string()] = time;
  }
  return times;
}

void Job::interrupt() {
  interrupted_ = true;
  process_.interrupt();
}

std::optional<JobResult> Job::update() {
  const auto end = process_.end();  // first: what it wrote before its end is then read, too
  reader_.read(process_.read_progress());
  if (!end) return std::nullopt;
  return result_of(*end);
}

std::string Job::last_line() const {
  std::ifstream file(log_);
  file.seekg(static_cast<std::streamoff>(log_begin_));
  std::string last;
  for (std::string line; std::getline(file, line);) {
    if (!trimmed(line).empty()) last = trimmed(line);
  }
  return last;
}

JobResult Job::result_of(const ProcessEnd& end) const {
  JobResult result;
  const JobProgress& told = progress();
  result.log = log_;
  result.exit_code = end.exit_code;
  result.success = end.exit_code == tool::kDone;
  for (const auto& [file, time] : written()) {
    const auto old = before_.find(file);
    if (old == before_.end() || old->second != time) result.files.push_back(file);
  }
  if (result.success) {
    result.headline = told.headline.value_or("done");
    return result;
  }
  // Before it listens, the signal itself ends it.
  const bool by_interrupt = end.exit_code == tool::kInterrupted;
  result.interrupted = interrupted_ && by_interrupt;
  if (end.signal && !result.interrupted) {
    result.error =
        "killed by signal " + std::to_string(*end.signal) + " (" + strsignal(*end.signal) + ")";
  } else {
    result.error = told.error ? *told.error : last_line();
  }
  if (result.error.empty()) {
    result.error = "ended with status " + std::to_string(end.exit_code) + " without saying why";
  }
  result.headline = result.error;
  if (by_interrupt) {
    result.headline = commands_robot_ ? "interrupted: the motors stop, and nothing is kept"
                                      : "interrupted; the same goal goes on from there";
    if (told.headline) result.headline += "; " + *told.headline;
  }
  return result;
}

}  // namespace jobs
}  // namespace anthrob
