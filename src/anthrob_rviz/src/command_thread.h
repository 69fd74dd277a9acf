#pragma once

#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "command_repeater.h"

namespace anthrob {

/// Repeats commands in a thread of its own: RViz's thread may draw for longer than a command is
/// valid. If it hangs, the deadline that it set last ends them.
class CommandThread {
 public:
  using Send = std::function<void(const std::vector<Reference>&)>;

  /// @param send called by the thread
  explicit CommandThread(Send send);
  ~CommandThread();

  /// As CommandRepeater::set. Once it has returned, nothing older is sent.
  void set(std::vector<Reference> references, double deadline);

 private:
  void run();
  bool send_due();

  Send send_;
  std::mutex mutex_;
  CommandRepeater repeater_;
  bool quit_ = false;
  std::thread thread_;
};

}  // namespace anthrob
