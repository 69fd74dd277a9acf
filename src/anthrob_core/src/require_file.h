#pragma once

#include <filesystem>
#include <string>

namespace anthrob {

/// @throws BadInput if there is no such file, naming the models of that folder if `path` looks like
/// one, or if it is a folder
void require_file(const std::string& path);

/// NAMEs of the files model_NAME.yaml in a folder, separated by commas.
std::string models_in(const std::filesystem::path& folder);

}  // namespace anthrob
