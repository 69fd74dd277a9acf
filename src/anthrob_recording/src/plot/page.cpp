#include "anthrob_recording/page.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "anthrob_core/programs.h"

namespace anthrob {

namespace {

namespace fs = std::filesystem;

/// All that is written into a pipe, until its other end is closed.
std::string read_all(int pipe) {
  std::string text;
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t count = read(pipe, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

/// @return what the program complained about; none: it has done its work
std::optional<std::string> complaint_of(std::vector<std::string> command) {
  std::vector<char*> arguments;
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return std::strerror(errno);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  pid_t child = 0;
  const int error = posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  std::string complaint = error == 0 ? read_all(ends[0]) : command[0] + ": " + std::strerror(error);
  close(ends[0]);
  if (error != 0) return complaint;
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return std::nullopt;
  while (!complaint.empty() && complaint.back() == '\n') complaint.pop_back();
  // Of a program that broke down, the last line tells.
  complaint.erase(0, complaint.rfind('\n') + 1);
  return complaint.empty() ? command[0] + ": ended without saying why" : complaint;
}

}  // namespace

void write_page(const std::string& name, const std::string& data, const std::string& page) {
  std::optional<std::string> complaint;
  try {
    complaint = complaint_of(
        {program_of_package("anthrob_recording", "anthrob_page"), name, data, "--out", page});
  } catch (const std::runtime_error& error) {
    complaint = error.what();
  }
  if (!complaint) return;
  std::error_code error;
  fs::remove(page, error);
  throw std::runtime_error(page + ": not written: " + *complaint + "; " + data +
                           " is complete, and `rosrun anthrob_recording anthrob_page " + name +
                           " " + data + "` makes the page from it");
}

std::vector<std::string> figures_of(const OutputFiles& files) {
  std::vector<std::string> names;
  for (const auto& [name, content] : files) {
    if (fs::path(name).extension() == ".svg") names.push_back(name);
  }
  return names;
}

void remove_other_figures(const std::string& folder, const std::set<std::string>& kinds,
                          const OutputFiles& files) {
  std::error_code error;  // no such folder: nothing to remove
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(fs::path(folder) / "figures", error)) {
    const fs::path& file = entry.path();
    std::string kind = file.stem().string();
    const std::size_t end = kind.find_last_not_of("0123456789");
    if (end != std::string::npos && kind[end] == '_') kind.erase(end);
    const bool ours = file.extension() == ".svg" && kinds.count(kind);
    if (ours && !files.count("figures/" + file.filename().string())) old.push_back(file);
  }
  for (const fs::path& file : old) fs::remove(file, error);
}

}  // namespace anthrob
