#pragma once

#include <ros/callback_queue.h>

#include <cstdint>
#include <functional>

namespace anthrob {
namespace driver {

/// Service calls that wait for a thread. Each keeps a count that was read when it came in, so that
/// the thread that carries it out can tell what has happened since.
class RequestQueue final : public ros::CallbackQueue {
 public:
  /// @param count read in ROS's thread, whenever a call comes in
  explicit RequestQueue(std::function<std::uint64_t()> count) : count_(std::move(count)) {}

  void addCallback(const ros::CallbackInterfacePtr& call, std::uint64_t owner) override;
  /// The count of the call that this thread carries out now; 0 if it carries out none.
  static std::uint64_t received();

 private:
  std::function<std::uint64_t()> count_;
};

}  // namespace driver
}  // namespace anthrob
