#pragma once

#include <string>

namespace anthrob {

/// Keeps other runs out of an output folder for as long as it lives, and leaves no file behind. A
/// run that is killed keeps nobody out.
class FolderLock {
 public:
  /// @throws BadInput if another run has it
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace anthrob
