#pragma once

#include <string>
#include <utility>
#include <vector>

namespace anthrob {

/// Until a file, or what a folder lists, is on the disk: what is renamed before that may be there
/// without its content after a power cut. As far as the file system can.
/// @throws std::runtime_error if the disk does not take it
void keep_on_disk(const std::string& path);

/// Writes beside the target and renames, so that the target is either the old or the complete new
/// file.
/// @throws std::runtime_error naming the file and the reason
void write_file_atomically(const std::string& file, const std::string& content);

/// Files that belong together, by name and content: all are complete beside their targets before
/// the first is renamed, so that a full disk replaces none of them.
/// @throws std::runtime_error naming the file and the reason
void write_files_atomically(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace anthrob
