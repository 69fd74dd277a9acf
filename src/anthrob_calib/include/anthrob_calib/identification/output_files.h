#pragma once

#include <map>
#include <string>
#include <vector>

namespace anthrob {
namespace identification {

/// Files of a report by name, complete in memory before the first is written.
using OutputFiles = std::map<std::string, std::string>;

/// Makes sure that files can be written into a folder, or that it can be made.
/// @throws std::runtime_error with one line: the folder and the reason
void require_writable(const std::string& folder);

/// Makes sure that what is read is not replaced by what is written.
/// @param names of files in the folder   @param read canonical paths
/// @throws BadInput with one line: the folder and the name
void require_kept(const std::string& folder, const std::vector<std::string>& names,
                  const std::vector<std::string>& read);

/// Makes the folder. Writes all or nothing of each file; an older file of that name is replaced.
/// @throws std::runtime_error naming the file and the reason
void write_files(const std::string& folder, const OutputFiles& files);

}  // namespace identification
}  // namespace anthrob
