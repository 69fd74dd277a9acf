#pragma once

#include <string>
#include <vector>

namespace anthrob {

/// Canonical paths of a YAML file and of all files that it extends.
/// @param file one that ConfigNode::load() accepts
/// @throws BadInput if a file is missing or is not YAML
std::vector<std::string> extended_files(const std::string& file);

}  // namespace anthrob
