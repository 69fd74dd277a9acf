#include "output_folder.h"

#include <algorithm>
#include <filesystem>
#include <regex>

#include "loop/closed_loop.h"

namespace anthrob {
namespace discovery {

void remove_other_recordings(const std::string& folder, const std::vector<std::string>& made,
                             const LoopOptions& options) {
  namespace fs = std::filesystem;
  for (const std::string& name : loop_recordings(options)) {
    const fs::path recording = fs::path(folder) / name;
    const bool is_old = std::find(made.begin(), made.end(), name) == made.end();
    if (!is_old || !fs::exists(recording / "meta.yaml")) continue;
    for (const fs::directory_entry& entry : fs::directory_iterator(recording)) {
      const fs::path& file = entry.path();
      // Only files of a dataset.
      if (file.filename() == "meta.yaml" || file.extension() == ".csv") fs::remove(file);
    }
    if (fs::is_empty(recording)) fs::remove(recording);
  }
}

void remove_other_protocols(const std::string& folder,
                            const std::map<std::string, std::string>& files) {
  namespace fs = std::filesystem;
  std::vector<fs::path> others;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path& path = entry.path();
    static const std::regex kOurs("separating_[0-9]+(_postures)?\\.yaml");
    const bool is_protocol =
        std::regex_match(path.filename().string(), kOurs) && entry.is_regular_file();
    if (is_protocol && !files.count(path.filename().string())) others.push_back(path);
  }
  for (const fs::path& path : others) fs::remove(path);
}

}  // namespace discovery
}  // namespace anthrob
