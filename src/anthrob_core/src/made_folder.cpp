#include <utility>

#include "anthrob_core/files.h"

namespace anthrob {

namespace fs = std::filesystem;

MadeFolder::MadeFolder(const fs::path& folder) {
  std::error_code unseen;
  fs::path missing = (fs::absolute(folder, unseen) / ".").lexically_normal().parent_path();
  while (!missing.empty() && !fs::exists(missing, unseen)) {
    made_.push_back(missing);
    missing = missing.parent_path();
  }
  fs::create_directories(folder, error_);
  exists_ = fs::is_directory(folder, unseen);
  if (!error_ && unseen) error_ = unseen;
}

void MadeFolder::take_back() {
  std::error_code stays;
  for (const fs::path& folder : std::exchange(made_, {})) fs::remove(folder, stays);
}

}  // namespace anthrob
