#pragma once

#include <array>

#include "anthrob_ecu/frame.h"

namespace anthrob {
namespace ecu {

/// Frames that wait for the CAN controller, in fixed memory. If the queue is full, the oldest frame
/// is dropped: a new measurement is worth more than an old one.
class SendQueue {
 public:
  void push(const Frame& frame) {
    frames_[(first_ + count_) % kSize] = frame;
    if (count_ < kSize) {
      ++count_;
    } else {
      first_ = (first_ + 1) % kSize;
    }
  }
  bool pop(Frame& frame) {
    if (count_ == 0) return false;
    frame = frames_[first_];
    first_ = (first_ + 1) % kSize;
    --count_;
    return true;
  }
  void clear() { count_ = 0; }

 private:
  static constexpr std::size_t kSize = 16;
  std::array<Frame, kSize> frames_{};
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace ecu
}  // namespace anthrob
