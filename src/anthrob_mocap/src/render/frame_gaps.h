#pragma once

#include <deque>
#include <map>
#include <string>
#include <utility>

namespace anthrob {
namespace mocap {

/// Gaps between the stamps of moving frames. tf interpolates across any of them, though a link may
/// have moved in any way meanwhile.
class FrameGaps {
 public:
  struct Options {
    double longest = 0.1;  ///< [s] between two stamps; more is a gap
    double memory = 10.0;  ///< [s] for which gaps are kept: as long as tf keeps transforms
  };

  explicit FrameGaps(const Options& options) : options_(options) {}

  /// @param t [s] stamp of a transform of the frame; one that steps back by more than the memory
  ///   starts over
  void add(const std::string& frame, double t);
  /// Whether the time [s] lies in a gap of the frame. Frames that are not known are static.
  bool hold(const std::string& frame, double t) const;

 private:
  struct Stamps {
    double last = 0.0;                           ///< [s]
    std::deque<std::pair<double, double>> gaps;  ///< [s] their ends
  };

  Options options_;
  std::map<std::string, Stamps> frames_;
};

}  // namespace mocap
}  // namespace anthrob
