#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace anthrob {

class WrappingSurface;

/// Surfaces that were prepared before, by the text that describes them. Preparing a bone takes a
/// tenth of a second, and searches build the same robot thousands of times; surfaces are immutable,
/// so that all may share one. Any number of threads.
class MeshCache {
 public:
  using Surface = std::shared_ptr<const WrappingSurface>;

  /// The surface of this description, prepared if it is new. What throws is not kept.
  Surface get(const std::string& description, const std::function<Surface()>& prepare);

 private:
  /// Searches that move meshes come with ever new descriptions; then it starts over.
  static constexpr std::size_t kCapacity = 256;

  std::mutex mutex_;
  std::map<std::string, Surface> surfaces_;
};

}  // namespace anthrob
