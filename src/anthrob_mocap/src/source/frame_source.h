#pragma once

#include <optional>
#include <string>

#include "pipeline/stereo_frame.h"
#include "source/pairing.h"

namespace anthrob {
namespace mocap {

/// Where pairs of images come from.
class FrameSource {
 public:
  enum class Grab { kFrame, kNothing, kEnd };

  virtual ~FrameSource() = default;

  /// Fills index, t, image and owner of a frame; waits at most `timeout` [s]. A pair whose images
  /// cannot be used has a fault.
  /// @throws BadInput if the source as a whole cannot be used
  virtual Grab next(StereoFrame& frame, double timeout) = 0;

  /// What is wrong with the cameras at the moment, in one line; none if nothing is. Sources
  /// recover by themselves: keep calling next.
  virtual std::optional<std::string> trouble() const { return std::nullopt; }

  /// Counts of images and pairs since the last call, for sources that pair images.
  virtual Pairing::Counts take_counts() { return {}; }
};

}  // namespace mocap
}  // namespace anthrob
