#pragma once

#include <cstddef>
#include <vector>

#include "anthrob_recording/table.h"

namespace anthrob {

/// One number at one instant.
struct Sample {
  Nanoseconds t = 0;
  double value = 0.0;
};

/// Samples in the order of time that somebody else keeps.
class SampleSpan {
 public:
  SampleSpan() = default;
  SampleSpan(const Sample* first, const Sample* last) : first_(first), last_(last) {}
  explicit SampleSpan(const std::vector<Sample>& samples)
      : SampleSpan(samples.data(), samples.data() + samples.size()) {}

  const Sample* begin() const { return first_; }
  const Sample* end() const { return last_; }
  const Sample& front() const { return *first_; }
  const Sample& back() const { return last_[-1]; }
  std::size_t size() const { return static_cast<std::size_t>(last_ - first_); }
  bool empty() const { return first_ == last_; }

  /// The first sample that is not before t, or the end.
  const Sample* at_or_after(Nanoseconds t) const;

 private:
  const Sample* first_ = nullptr;
  const Sample* last_ = nullptr;
};

/// The samples of the last so many seconds, all of them.
class SampleWindow {
 public:
  explicit SampleWindow(Nanoseconds width) : width_(width) {}

  /// Two publishers may overtake each other: up to 0.5 s late, a sample is put in its place.
  /// Beyond, the clock was put back, and all begins anew.
  void add(const Sample& sample);
  /// Valid until the next add().
  SampleSpan span() const { return {samples_.data() + begin_, samples_.data() + samples_.size()}; }
  /// [bytes] that it occupies
  std::size_t bytes() const { return samples_.capacity() * sizeof(Sample); }

 private:
  void forget();

  Nanoseconds width_;
  std::size_t begin_ = 0;  ///< what lies before is forgotten, and removed now and then
  std::vector<Sample> samples_;
};

}  // namespace anthrob
