#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "anthrob_recording/table.h"

namespace anthrob {
namespace twin {

/// The last samples of a topic in the order of their stamps. Does not allocate after construction.
template <class Sample>
class Timeline {
 public:
  /// @param blank of the size that all have   @param capacity of samples, > 0
  Timeline(const Sample& blank, std::size_t capacity) : slots_(capacity, blank) {}

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  /// From the oldest, 0, to the newest.
  const Sample& operator[](std::size_t i) const { return slots_[slot(i)]; }
  const Sample& newest() const { return (*this)[size_ - 1]; }
  void clear() { size_ = 0; }

  bool holds(Nanoseconds stamp) const {
    for (std::size_t i = size_; i > 0; --i) {
      if ((*this)[i - 1].stamp <= stamp) return (*this)[i - 1].stamp == stamp;
    }
    return false;
  }

  /// Puts a sample where its stamp belongs. If there is no room, the oldest one is forgotten.
  void insert(const Sample& sample) {
    if (size_ == slots_.size()) forget(1);
    slots_[slot(size_)] = sample;
    for (std::size_t i = size_++; i > 0 && (*this)[i - 1].stamp > sample.stamp; --i) {
      std::swap(slots_[slot(i - 1)], slots_[slot(i)]);
    }
  }

  /// Forgets what is older than the last sample at or before `time`.
  void forget_before(Nanoseconds time) {
    std::size_t count = 0;
    while (count + 1 < size_ && (*this)[count + 1].stamp <= time) ++count;
    forget(count);
  }

  /// The last sample at or before `time`, or the oldest.
  std::size_t before(Nanoseconds time) const {
    std::size_t i = 0;
    while (i + 1 < size_ && (*this)[i + 1].stamp <= time) ++i;
    return i;
  }
  /// The first sample at or after `time`, or the newest.
  std::size_t after(Nanoseconds time) const {
    std::size_t i = 0;
    while (i + 1 < size_ && (*this)[i].stamp < time) ++i;
    return i;
  }

  /// Two neighbours and how far `time` is from the first to the second; 0 or 1 beyond the ends.
  struct Between {
    const Sample &from, &to;
    double share;
  };
  Between between(Nanoseconds time) const {
    const std::size_t i = before(time), j = std::min(i + 1, size_ - 1);
    const Nanoseconds length = (*this)[j].stamp - (*this)[i].stamp;
    const double share =
        length > 0 ? static_cast<double>(time - (*this)[i].stamp) / static_cast<double>(length)
                   : 0.0;
    return {(*this)[i], (*this)[j], std::clamp(share, 0.0, 1.0)};
  }

 private:
  std::size_t slot(std::size_t i) const { return (begin_ + i) % slots_.size(); }
  void forget(std::size_t count) {
    begin_ = slot(count);
    size_ -= count;
  }

  std::vector<Sample> slots_;
  std::size_t begin_ = 0, size_ = 0;
};

}  // namespace twin
}  // namespace anthrob
