#include "source/live_pair.h"

#include <chrono>
#include <cstdio>

#include "anthrob_core/errors.h"
#include "anthrob_core/monotonic_clock.h"

namespace anthrob {
namespace mocap {

namespace {

constexpr std::size_t kMostPairs = 4;  // that wait to be taken; older ones are dropped

}  // namespace

void LivePair::add(Side side, const TimedImage& image) {
  const std::lock_guard<std::mutex> lock(mutex_);
  last_image_[side] = monotonic_now();
  trouble_[side].reset();
  Pair pair;
  try {
    if (!pairing_.add(side, image, pair.image)) return;
  } catch (const BadInput& error) {
    trouble_[side] = error.what();
    return;
  }
  last_pair_ = monotonic_now();
  pairs_.push_back(pair);
  if (pairs_.size() > kMostPairs) pairs_.pop_front(), late_ += 2;
  arrived_.notify_one();
}

void LivePair::set_trouble(Side side, const std::optional<std::string>& what) {
  const std::lock_guard<std::mutex> lock(mutex_);
  trouble_[side] = what;
}

bool LivePair::next(StereoFrame& frame, double timeout) {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto wait = std::chrono::duration<double>(timeout);
  if (!arrived_.wait_for(lock, wait, [this] { return !pairs_.empty(); })) return false;
  for (const Side side : {kLeft, kRight}) {
    frame.image[side] = pairs_.front().image[side].image;
    frame.owner[side] = pairs_.front().image[side].owner;
  }
  frame.t = pairs_.front().image[kLeft].t;
  frame.ns = pairs_.front().image[kLeft].ns;
  frame.index = index_++;
  pairs_.pop_front();
  return true;
}

Pairing::Counts LivePair::take_counts() {
  const std::lock_guard<std::mutex> lock(mutex_);
  Pairing::Counts counts = pairing_.take_counts();
  counts.lost += late_;
  late_ = 0;
  return counts;
}

std::optional<std::string> LivePair::trouble() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const double t = monotonic_now();
  const Side first = last_image_[kRight] < last_image_[kLeft] ? kRight : kLeft;
  for (const Side side : {first, first == kLeft ? kRight : kLeft}) {
    const std::string who = std::string(name(side)) + " camera: ";
    if (trouble_[side]) return who + *trouble_[side];
    if (t - last_image_[side] < silence_) continue;
    if (last_image_[side] == 0.0) return who + "no image yet";
    char text[64];
    std::snprintf(text, sizeof(text), "no image for %.1f s", t - last_image_[side]);
    return who + text;
  }
  if (t - last_pair_ > silence_) {
    char text[96];
    std::snprintf(text, sizeof(text),
                  "unsynchronised pair: no left and right image within %.1f ms of each other",
                  1e3 * pairing_.tolerance());
    return text;
  }
  return std::nullopt;
}

}  // namespace mocap
}  // namespace anthrob
