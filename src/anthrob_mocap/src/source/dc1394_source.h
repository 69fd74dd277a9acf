#pragma once

#include <memory>

#include "source/camera_options.h"
#include "source/frame_source.h"

namespace anthrob {
namespace mocap {

/// Two FireWire cameras on one bus through libdc1394, as in the thesis (section A.3.1), named by
/// their GUID in hexadecimal. Stamps are the driver's minus half the exposure.
/// We compile this source but have never run it, because we have no such camera.
class Dc1394Source final : public FrameSource {
 public:
  /// @throws BadInput if a name is no GUID, the trigger neither external nor free, or a number
  ///   makes no sense
  explicit Dc1394Source(const CameraOptions& options);
  ~Dc1394Source() override;

  Grab next(StereoFrame& frame, double timeout) override;
  std::optional<std::string> trouble() const override;
  Pairing::Counts take_counts() override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mocap
}  // namespace anthrob
