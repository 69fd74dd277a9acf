#include "source/pairing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace mocap {

namespace {

constexpr std::size_t kMostWaiting = 8;  // images per side; of more, the oldest are lost
constexpr std::size_t kIntervals = 9;    // between images; their median is the period
constexpr double kAnotherTime = 1.0;     // [s] a step back that starts over
constexpr int kAdvancing = 4;            // refused stamps in a row; after them it starts over
constexpr double kBearableLoss = 0.05;   // [1] of all images; a few are lost at every start

}  // namespace

void Pairing::advance(Side side, double t) {
  std::optional<double>& last = last_[side];
  if (last && t <= *last) {
    int& advancing = advancing_[side];
    advancing = refused_[side] && t > *refused_[side] ? advancing + 1 : 1;
    refused_[side] = t;
    if (t > *last - kAnotherTime && advancing <= kAdvancing) {
      char text[128];
      std::snprintf(text, sizeof(text),
                    "stamp %.6f s: expected one later than the previous, %.6f s", t, *last);
      throw BadInput(text);
    }
    lose(side, waiting_[side].size());  // they are of the time before
  } else if (last) {
    intervals_.push_back(t - *last);
    if (intervals_.size() > kIntervals) intervals_.pop_front();
  }
  last = t;
  refused_[side].reset();
}

/// Drops the oldest waiting images, which have no partner.
void Pairing::lose(Side side, std::size_t count) {
  std::deque<TimedImage>& waiting = waiting_[side];
  waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(count));
  counts_.lost += static_cast<int>(count);
}

void Pairing::end() {
  for (const Side side : {kLeft, kRight}) lose(side, waiting_[side].size());
}

double Pairing::period() const {
  if (intervals_.empty()) return 0.0;
  // The median: late images come in bursts, lost ones leave gaps.
  std::deque<double> sorted = intervals_;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

double Pairing::tolerance() const {
  return intervals_.empty() ? tolerance_ : std::min(tolerance_, 0.5 * period());
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
    lose(other, best);
    theirs.pop_front();
    lose(side, mine.size());
    ++counts_.pairs;
    return true;
  }
  if (best < theirs.size()) {
    const double gap = (theirs[best].t - image.t) * (side == kLeft ? 1.0 : -1.0);
    if (counts_.nearest == 0.0 || std::abs(gap) < std::abs(counts_.nearest)) counts_.nearest = gap;
  }
  mine.push_back(image);
  if (mine.size() > kMostWaiting) lose(side, 1);
  return false;
}

Pairing::Counts Pairing::take_counts() {
  const Counts counts = counts_;
  counts_ = Counts();
  return counts;
}

std::optional<std::string> Pairing::complaint(const Counts& counts, double tolerance) {
  if (counts.images[kLeft] == 0 && counts.images[kRight] == 0) return "no images";
  for (const Side side : {kLeft, kRight}) {
    if (counts.images[side] == 0)
      return std::string("no images from the ") + name(side) + " camera";
  }
  if (counts.pairs > 0) return std::nullopt;
  char text[160];
  std::snprintf(text, sizeof(text),
                "unsynchronised pair: %d left and %d right images, none within %.1f ms; nearest "
                "%.1f ms apart",
                counts.images[kLeft], counts.images[kRight], 1e3 * tolerance,
                1e3 * std::abs(counts.nearest));
  return text;
}

std::optional<std::string> Pairing::loss(const Counts& counts) {
  const int images = counts.images[kLeft] + counts.images[kRight];
  if (counts.lost <= kBearableLoss * images) return std::nullopt;
  return std::to_string(counts.lost) + " of " + std::to_string(images) +
         " images have no partner, or came too late";
}

}  // namespace mocap
}  // namespace anthrob
