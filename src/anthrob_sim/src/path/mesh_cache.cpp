#include "path/mesh_cache.h"

namespace anthrob {

MeshCache::Surface MeshCache::get(const std::string& description,
                                  const std::function<Surface()>& prepare) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto known = surfaces_.find(description);
    if (known != surfaces_.end()) return known->second;
  }
  // Unlocked: others need not wait, and two that prepare the same get equal surfaces.
  Surface surface = prepare();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (surfaces_.size() >= kCapacity) surfaces_.clear();
  surfaces_.emplace(description, surface);
  return surface;
}

}  // namespace anthrob
