#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace anthrob {

/// Sets how many descriptors this process may have: as many as the system allows, at most 8192.
/// More would only cost time, since roscpp looks at every possible one whenever somebody connects.
void raise_descriptor_limit();

/// How many more descriptors this process may open.
std::size_t free_descriptors();

/// Shuts down connections to this node that are older than a second and on which nothing was ever
/// sent. Everybody who wants something of a ROS node begins to talk at once.
/// @return how many there were
std::size_t shut_down_idle_connections();

/// Keeps descriptors free for whoever wants to stop the robot, in a thread of its own. Each
/// connection takes one, and roscpp keeps idle ones for ever; without a free one nobody can connect
/// any more. When fewer than kReserve are free, idle connections are shut down.
class DescriptorWatch {
 public:
  /// roscpp's server, by which subscribers learn of publishers, turns everybody away when fewer
  /// than 32 are free.
  static constexpr std::size_t kReserve = 40;
  /// @param why in words
  using Scarce = std::function<void(const std::string& why)>;

  /// @param scarce called, once each time, by the watch's thread, when too few have been free for
  ///   2 s although idle connections were shut down
  explicit DescriptorWatch(Scarce scarce);
  ~DescriptorWatch();

 private:
  void watch();
  void look();

  Scarce on_scarce_;
  std::optional<double> since_;  ///< [s] since when too few are free
  bool told_ = false;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool quit_ = false;
  std::thread thread_;
};

}  // namespace anthrob
