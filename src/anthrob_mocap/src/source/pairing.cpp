#include "anthrob_mocap/source/pairing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "anthrob_config/errors.h"

namespace anthrob {
namespace mocap {

namespace {

constexpr std::size_t kMostWaiting = 8;  // more than this long no partner comes
constexpr std::size_t kIntervals = 9;    // whose median is the cameras' period
constexpr double kAnotherTime = 1.0;     // [s] back: a bag that loops, a simulator anew
constexpr int kAdvancing = 4;            // refused stamps in a row: a bag of less than that

}  // namespace

void Pairing::advance(Side side, double t) {
  std::optional<double>& last = last_[side];
  if (last && t <= *last) {
    int& advancing = advancing_[side];
    advancing = refused_[side] && t > *refused_[side] ? advancing + 1 : 1;
    refused_[side] = t;
    if (t > *last - kAnotherTime && advancing <= kAdvancing) {
      char text[96];
      std::snprintf(text, sizeof(text), "stamp %.6f s: expected one after %.6f s, the last", t,
                    *last);
      throw BadInput(text);
    }
    waiting_[side].clear();  // worth nothing any more
  } else if (last) {
    intervals_.push_back(t - *last);
    if (intervals_.size() > kIntervals) intervals_.pop_front();
  }
  last = t;
  refused_[side].reset();
}

double Pairing::tolerance() const {
  if (intervals_.empty()) return tolerance_;
  // The median: late images come in bursts, lost ones leave gaps.
  std::deque<double> sorted = intervals_;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return std::min(tolerance_, 0.5 * *middle);
}

bool Pairing::add(Side side, const TimedImage& image, TimedImage pair[2]) {
  const Side other = side == kLeft ? kRight : kLeft;
  std::deque<TimedImage>&mine = waiting_[side], &theirs = waiting_[other];
  ++counts_.images[side];
  advance(side, image.t);
  std::size_t best = theirs.size();
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    const double gap = std::abs(theirs[i].t - image.t);
    if (best == theirs.size() || gap < std::abs(theirs[best].t - image.t)) best = i;
  }
  if (best < theirs.size() && std::abs(theirs[best].t - image.t) <= tolerance()) {
    pair[side] = image, pair[other] = theirs[best];
    theirs.erase(theirs.begin(), theirs.begin() + static_cast<std::ptrdiff_t>(best) + 1);
    mine.clear();
    ++counts_.pairs;
    return true;
  }
  if (best < theirs.size()) {
    const double gap = (theirs[best].t - image.t) * (side == kLeft ? 1.0 : -1.0);
    if (counts_.nearest == 0.0 || std::abs(gap) < std::abs(counts_.nearest)) counts_.nearest = gap;
  }
  mine.push_back(image);
  if (mine.size() > kMostWaiting) mine.pop_front();
  return false;
}

Pairing::Counts Pairing::take_counts() {
  const Counts counts = counts_;
  counts_ = Counts();
  return counts;
}

std::string Pairing::complaint(const Counts& counts, double tolerance) {
  char text[160] = "";
  if (counts.images[kLeft] == 0 && counts.images[kRight] == 0) return "no images";
  for (const Side side : {kLeft, kRight}) {
    if (counts.images[side] == 0)
      return std::string("no images from the ") + name(side) + " camera";
  }
  if (counts.pairs == 0) {
    std::snprintf(text, sizeof(text),
                  "unsynchronised pair: %d left and %d right images, none within %.1f ms; nearest "
                  "%.1f ms apart",
                  counts.images[kLeft], counts.images[kRight], 1e3 * tolerance,
                  1e3 * std::abs(counts.nearest));
  }
  return text;
}

}  // namespace mocap
}  // namespace anthrob
