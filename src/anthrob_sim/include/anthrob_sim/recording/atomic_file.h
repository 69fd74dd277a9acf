#pragma once

#include <string>
#include <utility>
#include <vector>

namespace anthrob {

/// Writes beside the target and renames, so that the target is either the old or the complete new
/// file.
/// @throws std::runtime_error naming the file and the reason
void write_file_atomically(const std::string& file, const std::string& content);

/// Files that belong together, by name and content: all are complete beside their targets before
/// the first is renamed, so that a full disk replaces none of them.
/// @throws std::runtime_error naming the file and the reason
void write_files_atomically(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace anthrob
