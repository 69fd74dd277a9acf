#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace anthrob {

/// Waits until a file, or a folder's list of files, is on the disk, as far as the file system
/// supports it. A file that is renamed earlier may be empty after a power cut.
/// @throws std::runtime_error if the disk is full or fails
void keep_on_disk(const std::string& path);

/// Canonical path of what is, or will be, at `path`: also where a folder on the way does not exist
/// yet ("new/../old"), or is a link. Two names of one place give the same path.
std::filesystem::path place_of(const std::filesystem::path& path);

/// The name FILE.part<pid>, beside FILE, for what is written until it is complete. It is made as a
/// new, empty file: whatever has that name, such as a link to another file, is not written to. If
/// it is not moved, it is deleted. What a killed process left of the same FILE is deleted first.
class PartFile {
 public:
  /// All members throw std::runtime_error naming FILE and the reason.
  explicit PartFile(const std::string& file);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  const std::string& path() const { return part_; }
  void move_to(const std::string& place);
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  void forget() const;

  std::string file_, part_;
  std::filesystem::path place_;  ///< of the part
  bool moved_ = false;
};

/// A file that is written beside its final place and moved there once it is complete. So the place
/// always has either the old file or the complete new one. If it is not moved, it is deleted.
class AtomicFile {
 public:
  /// All members throw std::runtime_error naming the file and the reason.
  explicit AtomicFile(const std::string& file);

  std::ostream& stream() { return out_; }
  /// Finishes writing: everything is then on the disk, beside its final place.
  void close();
  /// After close().
  void move_into_place();
  /// After close(), for an unfinished result: moves it to FILE.partial and leaves FILE unchanged.
  /// @return the name FILE.partial
  std::string move_beside();

 private:
  std::string file_;
  PartFile part_;
  std::ofstream out_;
};

/// @throws std::runtime_error naming the file and the reason
void write_file_atomically(const std::string& file, const std::string& content);

/// Writes files that belong together.
/// @param files name and content. All are complete beside their targets before the first is
/// renamed, so that a full disk replaces none of them
/// @throws std::runtime_error naming the file and the reason
void write_files_atomically(const std::vector<std::pair<std::string, std::string>>& files);

/// Creates a folder with all folders above it, and can take that back: what is refused later leaves
/// no empty folders behind.
class MadeFolder {
 public:
  /// Does not throw: `exists` and `error` tell whether it is there, and why not.
  explicit MadeFolder(const std::filesystem::path& folder);

  bool exists() const { return exists_; }
  const std::error_code& error() const { return error_; }
  /// Removes the folders that were created, as far as they are empty.
  void take_back();

 private:
  std::vector<std::filesystem::path> made_;  ///< deepest first
  bool exists_ = false;
  std::error_code error_;
};

/// Contents of a report's files by name, also "FOLDER/NAME"; all are complete before the first one
/// is written.
using OutputFiles = std::map<std::string, std::string>;

/// Checks that files can be written into a folder, or that it can be created.
/// @throws std::runtime_error with one line: the folder and the reason
void require_writable(const std::string& folder);

/// Checks that no input file would be overwritten, by whatever name it was given.
/// @param names of the files that will be written into the folder
/// @param read places of the input files (place_of)
/// @throws BadInput with one line: the folder and the name
void require_kept(const std::string& folder, const std::vector<std::string>& names,
                  const std::vector<std::string>& read);

/// Creates the folder and writes each file atomically; replaces older files of the same names.
/// @throws std::runtime_error naming the file and the reason
void write_files(const std::string& folder, const OutputFiles& files);

}  // namespace anthrob
