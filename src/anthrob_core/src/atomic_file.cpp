#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <deque>
#include <filesystem>
#include <stdexcept>

#include "anthrob_core/files.h"

namespace anthrob {

namespace {

std::string folder_of(const std::string& file) {
  const std::string folder = std::filesystem::path(file).parent_path().string();
  return folder.empty() ? "." : folder;
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

AtomicFile::AtomicFile(const std::string& file)
    : file_(file), part_(file), out_(part_.path(), std::ios::binary) {
  if (!out_) part_.fail(std::strerror(errno));
}

void AtomicFile::close() {
  out_.close();
  if (!out_) part_.fail(std::strerror(errno));
  keep_on_disk(part_.path());
}

void AtomicFile::move_into_place() {
  part_.move_to(file_);
}

std::string AtomicFile::move_beside() {
  const std::string beside = file_ + ".partial";
  part_.move_to(beside);
  return beside;
}

void write_file_atomically(const std::string& file, const std::string& content) {
  write_files_atomically({{file, content}});
}

void write_files_atomically(const std::vector<std::pair<std::string, std::string>>& files) {
  std::deque<AtomicFile> parts;
  for (const auto& [file, content] : files) {
    parts.emplace_back(file).stream() << content;
    parts.back().close();
  }
  for (AtomicFile& part : parts) part.move_into_place();
  for (const auto& [file, content] : files) keep_on_disk(folder_of(file));
}

}  // namespace anthrob
