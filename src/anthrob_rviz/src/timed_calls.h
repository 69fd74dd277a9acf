#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gains/gain.h"

namespace anthrob {

/// How a call of a service ended.
struct CallResult {
  std::string service;
  bool success = false;
  std::string message;
  std::vector<Gain> gains = {};  ///< that are held; of the service gains
};

/// Calls that may never return, each in a thread of its own, with a time limit. ROS 1 has none: a
/// call of a node that hangs waits until that node ends.
class TimedCalls {
 public:
  /// Touches nothing but what it holds itself: it may outlive everything else.
  using Call = std::function<CallResult()>;

  /// @param limit [s]
  /// @return false, and calls nothing, while a call of the same service is under way
  bool start(const std::string& service, Call call, double limit, double now);
  bool under_way(const std::string& service) const;
  /// Those that ended, or had no answer in time. Never waits.
  std::vector<CallResult> finished(double now);

 private:
  struct Answer;  ///< shared with the thread
  struct Pending {
    std::string service;
    double deadline = 0.0;
    double limit = 0.0;
    std::shared_ptr<Answer> answer;
  };
  std::vector<Pending> pending_;
};

}  // namespace anthrob
