#pragma once

#include <map>
#include <string>
#include <vector>

namespace anthrob {
namespace identification {

/// Contents of a report's files by name; all are complete before the first one is written.
using OutputFiles = std::map<std::string, std::string>;

/// Checks that files can be written into a folder, or that it can be created.
/// @throws std::runtime_error with one line: the folder and the reason
void require_writable(const std::string& folder);

/// Checks that no input file would be overwritten.
/// @param names of the files that will be written into the folder
/// @param read canonical paths of the input files
/// @throws BadInput with one line: the folder and the name
void require_kept(const std::string& folder, const std::vector<std::string>& names,
                  const std::vector<std::string>& read);

/// Creates the folder and writes each file atomically; replaces older files of the same names.
/// @throws std::runtime_error naming the file and the reason
void write_files(const std::string& folder, const OutputFiles& files);

}  // namespace identification
}  // namespace anthrob
