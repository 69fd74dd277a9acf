#pragma once

#include <string>
#include <vector>

namespace anthrob {

/// A YAML file and all that it extends, by canonical path: what must stay for it to be read again.
/// @param file one that ConfigNode::load() accepts
/// @throws BadInput if a file is missing or is not YAML
std::vector<std::string> extended_files(const std::string& file);

}  // namespace anthrob
