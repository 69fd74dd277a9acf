#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

#include "source/frame_source.h"
#include "source/pairing.h"

namespace anthrob {
namespace mocap {

/// Pairs the images that the threads of two cameras deliver, and notices when a camera is silent.
class LivePair {
 public:
  /// @param silence [s] without images after which trouble() reports the camera
  explicit LivePair(double sync_tolerance, double silence = 0.5)
      : silence_(silence), pairing_(sync_tolerance) {}

  /// Called by the camera's thread for each image.
  void add(Side side, const TimedImage& image);
  /// Called by the camera's thread: what is wrong with the camera; none if nothing is.
  void set_trouble(Side side, const std::optional<std::string>& what);

  /// Takes the oldest pair that was not taken yet; waits at most `timeout` [s].
  /// @return false if there was none
  bool next(StereoFrame& frame, double timeout);
  /// What is wrong, in one line; none if nothing is. Begins with the camera that has been silent
  /// for longer: both of a triggered pair may fall silent when one is pulled.
  std::optional<std::string> trouble() const;
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
  std::optional<std::string> trouble_[2];
  double last_image_[2] = {0.0, 0.0}, last_pair_ = 0.0;  ///< [s] steady clock; 0: none yet
  int late_ = 0;  ///< images since the last take_counts that nobody took in time
  std::uint64_t index_ = 0;
};

}  // namespace mocap
}  // namespace anthrob
