#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace anthrob {

class WrappingSurface;

/// Prepared surfaces by the text that describes them. Preparing a bone takes a tenth of a second,
/// and searches build the same robot thousands of times. Surfaces are immutable, so all robots can
/// share one. Thread-safe.
class MeshCache {
 public:
  using Surface = std::shared_ptr<const WrappingSurface>;

  /// The surface of this description, prepared if it is new. If `prepare` throws, nothing is
  /// cached.
  Surface get(const std::string& description, const std::function<Surface()>& prepare);

 private:
  /// The cache is emptied when it is full: searches that move meshes ask for ever new descriptions.
  static constexpr std::size_t kCapacity = 256;

  std::mutex mutex_;
  std::map<std::string, Surface> surfaces_;
};

}  // namespace anthrob
