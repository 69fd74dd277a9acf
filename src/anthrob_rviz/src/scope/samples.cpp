#include "scope/samples.h"

#include <algorithm>

namespace anthrob {
namespace {

constexpr Nanoseconds kMostOvertaken = 500000000;  // as in the reading of a bag
constexpr std::size_t kLeastRemoved = 1024;        // else short windows are moved all the time

bool earlier(const Sample& sample, Nanoseconds t) {
  return sample.t < t;
}

}  // namespace

const Sample* SampleSpan::at_or_after(Nanoseconds t) const {
  return std::lower_bound(first_, last_, t, earlier);
}

void SampleWindow::add(const Sample& sample) {
  if (samples_.size() == begin_ || sample.t >= samples_.back().t) {
    samples_.push_back(sample);
  } else if (samples_.back().t - sample.t > kMostOvertaken) {
    samples_.clear();
    begin_ = 0;
    samples_.push_back(sample);
  } else {
    const auto later = [](Nanoseconds t, const Sample& other) { return t < other.t; };
    samples_.insert(std::upper_bound(samples_.begin() + static_cast<std::ptrdiff_t>(begin_),
                                     samples_.end(), sample.t, later),
                    sample);
  }
  forget();
}

void SampleWindow::forget() {
  const Nanoseconds first = samples_.back().t - width_;
  while (samples_[begin_].t < first) ++begin_;
  // At half, so that each sample is moved once on the average.
  if (begin_ < kLeastRemoved || 2 * begin_ < samples_.size()) return;
  samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(begin_));
  begin_ = 0;
}

}  // namespace anthrob
