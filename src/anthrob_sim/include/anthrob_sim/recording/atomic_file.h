#pragma once

#include <string>

namespace anthrob {

/// Writes beside the target and renames, so that the target is either the old or the complete new
/// file.
/// @throws std::runtime_error naming the file and the reason
void write_file_atomically(const std::string& file, const std::string& content);

}  // namespace anthrob
