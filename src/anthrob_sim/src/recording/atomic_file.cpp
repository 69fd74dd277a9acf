#include "anthrob_sim/recording/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace anthrob {

namespace {

std::string temporary_of(const std::string& file) {
  return file + ".part" + std::to_string(getpid());
}

std::string folder_of(const std::string& file) {
  const std::string folder = std::filesystem::path(file).parent_path().string();
  return folder.empty() ? "." : folder;
}

void write_beside(const std::string& file, const std::string& content) {
  std::ofstream out(temporary_of(file), std::ios::binary);
  out << content;
  out.close();
  if (!out) throw std::runtime_error(file + ": cannot be written: " + std::strerror(errno));
  keep_on_disk(temporary_of(file));
}

void move_into_place(const std::string& file) {
  std::error_code error;
  std::filesystem::rename(temporary_of(file), file, error);
  if (error) throw std::runtime_error(file + ": cannot be written: " + error.message());
}

}  // namespace

void keep_on_disk(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return;
  const bool lost = ::fsync(fd) != 0 && (errno == EIO || errno == ENOSPC || errno == EDQUOT);
  const std::string reason = std::strerror(errno);
  ::close(fd);
  if (lost) throw std::runtime_error(path + ": cannot be written: " + reason);
}

void write_file_atomically(const std::string& file, const std::string& content) {
  write_files_atomically({{file, content}});
}

void write_files_atomically(const std::vector<std::pair<std::string, std::string>>& files) {
  try {
    for (const auto& [file, content] : files) write_beside(file, content);
    for (const auto& [file, content] : files) move_into_place(file);
    for (const auto& [file, content] : files) keep_on_disk(folder_of(file));
  } catch (...) {
    std::error_code ignored;
    for (const auto& [file, content] : files) {
      std::filesystem::remove(temporary_of(file), ignored);
    }
    throw;
  }
}

}  // namespace anthrob
