#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scope/message_reader.h"

namespace anthrob {

/// A message that came just now.
struct LiveMessage {
  std::string topic;
  Nanoseconds t = 0;  ///< the stamp of its header, else when it came
  MessageNumbers numbers;
};

/// What is known of the ROS master. Without one there are no live topics.
struct MasterView {
  std::string uri;
  bool answers = false;
  std::set<std::string> topics;
};

/// The topics of a running robot. Nothing here waits.
class LiveTopics {
 public:
  virtual ~LiveTopics() = default;

  virtual MasterView master() const = 0;
  /// To be heard from now on; all others are no longer.
  virtual void hear(const std::set<std::string>& topics) = 0;
  /// What came since the last call.
  virtual std::vector<LiveMessage> take() = 0;
  /// What could not be read: unknown definitions, malformed messages; one line each.
  virtual std::vector<std::string> take_remarks() = 0;
};

}  // namespace anthrob
