#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace anthrob {

enum class Look;

/// Asks the ROS master once a second of wall time, in a thread of its own, whether it still knows
/// all that this node offers and hears. roscpp never does: after a roscore has died and come back,
/// nobody who is started then finds the node, and `rostopic pub emergency_stop` stops nothing.
///
/// What it knew once must stay, unless the node gave it up. If the master is gone or answers
/// without us, the registration is lost at once; if it keeps silent, after 10 s. As soon as a
/// master answers again, the watch registers everything again. It logs both, once. It also asks the
/// master for publishers of whose coming the node may not have heard.
class RegistrationWatch {
 public:
  /// @param why in words
  using Lost = std::function<void(const std::string& why)>;

  /// To be made after all topics and services that must be there.
  /// @param lost called once a loss, by the watch's thread, before it registers again; may be empty
  /// @param period [s] of wall time between two looks, > 0. A silent master has ten of them
  /// @throws std::runtime_error if the master does not answer within a minute
  explicit RegistrationWatch(Lost lost = {}, double period = 1.0);
  ~RegistrationWatch();

  /// Why this node is not registered now; none if it is. For any thread.
  std::optional<std::string> lost() const;

 private:
  class Implementation;

  void watch();
  void note(Look look);

  std::unique_ptr<Implementation> implementation_;
  Lost on_lost_;
  mutable std::mutex mutex_;
  std::condition_variable ended_;
  bool quit_ = false;
  std::optional<std::string> why_;
  std::thread thread_;
};

}  // namespace anthrob
