#pragma once

#include <memory>

#include "anthrob_mocap/source/camera_options.h"
#include "anthrob_mocap/source/frame_source.h"

namespace anthrob {
namespace mocap {

/// Two GenICam cameras (GigE Vision, USB3 Vision) through aravis; "Fake_1" is its built-in fake.
/// Each has a thread that connects, streams, and connects again when the camera is lost. Stamps are
/// those of arrival less half the exposure: the middle of the exposure, up to the transfer's start.
class AravisSource final : public FrameSource {
 public:
  /// @throws BadInput if options make no sense; cameras that are missing are waited for
  explicit AravisSource(const CameraOptions& options);
  ~AravisSource() override;

  Grab next(StereoFrame& frame, double timeout) override;
  std::string trouble() const override;
  Pairing::Counts take_counts() override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mocap
}  // namespace anthrob
