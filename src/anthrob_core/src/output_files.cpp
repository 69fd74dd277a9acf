#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "anthrob_core/errors.h"
#include "anthrob_core/files.h"

namespace anthrob {

namespace fs = std::filesystem;

void require_writable(const std::string& folder) {
  MadeFolder made(folder);
  if (!made.exists()) {
    throw std::runtime_error("--out " + folder + ": cannot be created: " +
                             (made.error() ? made.error().message() : "it is a file") +
                             "; expected a folder");
  }
  const std::string probe = (fs::path(folder) / ".writable").string();
  try {
    write_file_atomically(probe, "");
  } catch (const std::runtime_error& reason) {
    throw std::runtime_error("--out " + folder + ": " + reason.what());
  }
  std::error_code error;
  fs::remove(probe, error);
  made.take_back();
}

void require_kept(const std::string& folder, const std::vector<std::string>& names,
                  const std::vector<std::string>& read) {
  for (const std::string& name : names) {
    const std::string written = place_of(fs::path(folder) / name).string();
    if (std::find(read.begin(), read.end(), written) == read.end()) continue;
    throw BadInput(folder + ": its " + name +
                   " is an input of this run and would be overwritten; expected another folder");
  }
}

void write_files(const std::string& folder, const OutputFiles& files) {
  std::error_code error;  // write_files_atomically() says what is wrong
  fs::create_directories(folder, error);
  std::vector<std::pair<std::string, std::string>> paths;
  for (const auto& [name, content] : files) {
    const fs::path path = fs::path(folder) / name;
    fs::create_directories(path.parent_path(), error);
    paths.emplace_back(path.string(), content);
  }
  write_files_atomically(paths);
}

}  // namespace anthrob
