#pragma once

#include <memory>

#include "source/camera_options.h"
#include "source/frame_source.h"

namespace anthrob {
namespace mocap {

/// Two GenICam cameras (GigE Vision, USB3 Vision) through aravis; "Fake_1" is its built-in fake.
/// Each has a thread that connects, streams, and reconnects when the camera is lost. A stamp is the
/// arrival time minus half the exposure: the middle of the exposure, if the transfer starts at
/// once.
class AravisSource final : public FrameSource {
 public:
  /// @throws BadInput if an option is out of range; it waits for cameras that are missing
  explicit AravisSource(const CameraOptions& options);
  ~AravisSource() override;

  Grab next(StereoFrame& frame, double timeout) override;
  std::optional<std::string> trouble() const override;
  Pairing::Counts take_counts() override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mocap
}  // namespace anthrob
