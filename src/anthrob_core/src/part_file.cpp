#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "anthrob_core/files.h"

namespace anthrob {

namespace fs = std::filesystem;

namespace {

/// Parts that this process writes. A part of its number that is not among them was left by an
/// earlier process: numbers come again, in a container even the same one at every start.
std::set<fs::path> own_parts;
std::mutex own_parts_mutex;

std::string part_of(const std::string& file, pid_t process) {
  return file + ".part" + std::to_string(process);
}

/// The process that writes, or wrote, `name` as a part of `file`; none for other files.
std::optional<pid_t> writer_of(const std::string& name, const std::string& file) {
  const std::string begin = file + ".part";
  if (name.compare(0, begin.size(), begin) != 0) return std::nullopt;
  pid_t process = 0;
  const char* const end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + begin.size(), end, process);
  if (error != std::errc() || stop != end || process <= 0) return std::nullopt;
  return process;
}

bool is_at_work(pid_t writer, const fs::path& part) {
  if (writer == getpid()) return own_parts.count(part) > 0;
  return ::kill(writer, 0) == 0 || errno != ESRCH;
}

/// Deletes what killed processes left of a file. @param place of the file
void sweep(const fs::path& place) {
  std::error_code unreadable, stays;
  std::vector<fs::path> left;
  for (const auto& entry : fs::directory_iterator(place.parent_path(), unreadable)) {
    const auto writer = writer_of(entry.path().filename().string(), place.filename().string());
    if (writer && !is_at_work(*writer, entry.path())) left.push_back(entry.path());
  }
  for (const fs::path& part : left) fs::remove(part, stays);
}

/// Of the folder of FILE; FILE itself may be a link, which a part does not follow.
fs::path unfollowed(const fs::path& file) {
  return place_of(file.has_parent_path() ? file.parent_path() : fs::path(".")) / file.filename();
}

}  // namespace

fs::path place_of(const fs::path& path) {
  // Of what follows a folder that does not exist only ".." is resolved, and no links: hence twice.
  std::error_code error;
  fs::path place = fs::absolute(path, error);
  for (int i = 0; i < 2; ++i) {
    fs::path resolved = fs::weakly_canonical(place, error);
    if (error) return place.lexically_normal();  // such as links in a circle
    place = std::move(resolved);
  }
  return place;
}

PartFile::PartFile(const std::string& file)
    : file_(file), part_(part_of(file, getpid())), place_(unfollowed(part_)) {
  const std::lock_guard<std::mutex> lock(own_parts_mutex);
  sweep(unfollowed(file));
  constexpr mode_t kAsUsual = 0666;  // less the mask of the user
  const int fd =
      ::open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kAsUsual);
  if (fd < 0) fail(std::strerror(errno));
  ::close(fd);
  own_parts.insert(place_);
}

PartFile::~PartFile() {
  if (moved_) return;
  std::error_code ignored;
  fs::remove(part_, ignored);
  forget();
}

void PartFile::move_to(const std::string& place) {
  std::error_code error;
  fs::rename(part_, place, error);
  if (error) fail(error.message());
  moved_ = true;
  forget();
}

void PartFile::forget() const {
  const std::lock_guard<std::mutex> lock(own_parts_mutex);
  own_parts.erase(place_);
}

void PartFile::fail(const std::string& reason) const {
  throw std::runtime_error(file_ + ": cannot be written: " + reason);
}

}  // namespace anthrob
