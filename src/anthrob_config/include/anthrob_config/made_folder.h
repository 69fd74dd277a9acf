#pragma once

#include <filesystem>
#include <system_error>
#include <vector>

namespace anthrob {

/// Creates a folder with all folders above it, and can take that back: what is refused later leaves
/// no empty folders behind.
class MadeFolder {
 public:
  /// Does not throw: `exists` and `error` tell whether it is there, and why not.
  explicit MadeFolder(const std::filesystem::path& folder);

  bool exists() const { return exists_; }
  const std::error_code& error() const { return error_; }
  /// Removes the folders that were created, as far as they are empty.
  void take_back();

 private:
  std::vector<std::filesystem::path> made_;  ///< deepest first
  bool exists_ = false;
  std::error_code error_;
};

}  // namespace anthrob
