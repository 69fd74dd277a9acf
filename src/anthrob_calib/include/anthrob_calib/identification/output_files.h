#pragma once

#include <map>
#include <string>

namespace anthrob {
namespace identification {

/// Files of a report by name, complete in memory before the first is written.
using OutputFiles = std::map<std::string, std::string>;

/// Makes sure that files can be written into a folder, or that it can be made.
/// @throws BadInput with one line: the folder and the reason
void require_writable(const std::string& folder);

/// Makes the folder. Writes all or nothing of each file; an older file of that name is replaced.
/// @throws std::runtime_error naming the file and the reason
void write_files(const std::string& folder, const OutputFiles& files);

}  // namespace identification
}  // namespace anthrob
