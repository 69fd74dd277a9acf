#pragma once

#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace anthrob {

/// Waits until a file, or a folder's list of files, is on the disk, as far as the file system
/// supports it. A file that is renamed earlier may be empty after a power cut.
/// @throws std::runtime_error if the disk is full or fails
void keep_on_disk(const std::string& path);

/// A file that is written beside its final place and moved there once it is complete. So the place
/// always has either the old file or the complete new one. If it is not moved, it is deleted.
class AtomicFile {
 public:
  /// All members throw std::runtime_error naming the file and the reason.
  explicit AtomicFile(const std::string& file);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return out_; }
  /// Finishes writing: everything is then on the disk, beside its final place.
  void close();
  /// After close().
  void move_into_place();
  /// After close(), for an unfinished result: moves it to FILE.partial and leaves FILE unchanged.
  /// @return the name FILE.partial
  std::string move_beside();

 private:
  void move_to(const std::string& place);
  [[noreturn]] void fail(const std::string& reason) const;

  std::string file_, part_;
  std::ofstream out_;
};

/// @throws std::runtime_error naming the file and the reason
void write_file_atomically(const std::string& file, const std::string& content);

/// Writes files that belong together.
/// @param files name and content. All are complete beside their targets before the first is
/// renamed, so that a full disk replaces none of them
/// @throws std::runtime_error naming the file and the reason
void write_files_atomically(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace anthrob
