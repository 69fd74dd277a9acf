#include "anthrob_sim/recording/atomic_file.h"

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

void write_beside(const std::string& file, const std::string& content) {
  std::ofstream out(temporary_of(file), std::ios::binary);
  out << content;
  out.close();
  if (!out) throw std::runtime_error(file + ": cannot be written: " + std::strerror(errno));
}

void move_into_place(const std::string& file) {
  std::error_code error;
  std::filesystem::rename(temporary_of(file), file, error);
  if (error) throw std::runtime_error(file + ": cannot be written: " + error.message());
}

}  // namespace

void write_file_atomically(const std::string& file, const std::string& content) {
  write_files_atomically({{file, content}});
}

void write_files_atomically(const std::vector<std::pair<std::string, std::string>>& files) {
  try {
    for (const auto& [file, content] : files) write_beside(file, content);
    for (const auto& [file, content] : files) move_into_place(file);
  } catch (...) {
    std::error_code ignored;
    for (const auto& [file, content] : files) {
      std::filesystem::remove(temporary_of(file), ignored);
    }
    throw;
  }
}

}  // namespace anthrob
