#pragma once

#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace anthrob {

/// Until a file, or what a folder lists, is on the disk: what is renamed before that may be there
/// without its content after a power cut. As far as the file system can.
/// @throws std::runtime_error if the disk does not take it
void keep_on_disk(const std::string& path);

/// A file that is written beside its place and moved there when it is whole, so that its place has
/// the old file or the complete new one. What is not moved is removed.
class AtomicFile {
 public:
  /// @throws std::runtime_error naming the file and the reason, like the others
  explicit AtomicFile(const std::string& file);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return out_; }
  /// All that was written is on the disk, beside its place.
  void close();
  /// After close().
  void move_into_place();
  /// After close(), instead: what was not finished goes to FILE.partial, FILE stays as it is.
  /// @return its name
  std::string move_beside();

 private:
  void move_to(const std::string& place);
  [[noreturn]] void fail(const std::string& reason) const;

  std::string file_, part_;
  std::ofstream out_;
};

/// @throws std::runtime_error naming the file and the reason
void write_file_atomically(const std::string& file, const std::string& content);

/// Files that belong together, by name and content: all are complete beside their targets before
/// the first is renamed, so that a full disk replaces none of them.
/// @throws std::runtime_error naming the file and the reason
void write_files_atomically(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace anthrob
