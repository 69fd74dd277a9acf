#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>

#include "anthrob_mocap/source/frame_source.h"
#include "anthrob_mocap/source/pairing.h"

namespace anthrob {
namespace mocap {

/// Where the threads of two cameras meet: images come in as they arrive, pairs go out, and silence
/// is noticed.
class LivePair {
 public:
  /// @param silence [s] without images that is trouble
  explicit LivePair(double sync_tolerance, double silence = 0.5)
      : silence_(silence), pairing_(sync_tolerance) {}

  /// From the camera's thread.
  void add(Side side, const TimedImage& image);
  /// From the camera's thread: what is wrong with it; empty: all is well.
  void set_trouble(Side side, const std::string& what);

  /// The oldest pair not taken; waits at most `timeout` [s].
  bool next(StereoFrame& frame, double timeout);
  /// Of the camera that has been silent for longer first: cameras that are triggered together may
  /// all fall silent when one of them is pulled.
  std::string trouble() const;
  /// Since the last call.
  Pairing::Counts take_counts();

 private:
  struct Pair {
    TimedImage image[2];
  };
  const double silence_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  Pairing pairing_;
  std::deque<Pair> pairs_;
  std::string trouble_[2];
  double last_image_[2] = {0.0, 0.0}, last_pair_ = 0.0;  ///< [s] steady clock; 0: none yet
  int late_ = 0;  ///< images since the last take_counts that nobody took in time
  std::uint64_t index_ = 0;
};

}  // namespace mocap
}  // namespace anthrob
