#pragma once

#include <string>

namespace anthrob {

/// @throws BadInput if there is no such file, naming the models of that folder if `path` looks like
/// one, or if it is a folder
void require_file(const std::string& path);

}  // namespace anthrob
