#include "recording.h"

#include "anthrob_core/command_line.h"
#include "anthrob_core/errors.h"

namespace anthrob {
namespace mocap {

namespace {

void check_size(const StereoFrame& frame, const StereoRig& rig, const std::string& calibration) {
  for (const auto side : {kLeft, kRight}) {
    const ImageView& image = frame.image[side];
    if (image.width == rig.width() && image.height == rig.height()) continue;
    throw BadInput(frame.file[side] + ": " + std::to_string(image.width) + "x" +
                   std::to_string(image.height) + " pixels: expected " +
                   std::to_string(rig.width()) + "x" + std::to_string(rig.height()) + ", as in " +
                   calibration);
  }
}

}  // namespace

void Recording::add_options(CLI::App& app) {
  app.add_option("--left", left, "folder of images 000000.png, ..., 8-bit grey")->required();
  app.add_option("--right", right, "the same for the right camera")->required();
  app.add_option("--calibration", calibration, "folder with left.yaml and right.yaml")->required();
  app.add_option(
         "--sync-tolerance", folder.sync_tolerance,
         "[s] largest difference between the times of a pair, if both folders have a times.csv")
      ->check(tool::within(0.0, 10.0));
}

void Recording::refuse_contradiction(const Health& health) const {
  if (const auto why = health.contradiction()) throw BadInput(left + ", " + right + ": " + *why);
}

bool track_all(FolderSource& source, const StereoRig& rig, const Recording& recording,
               Pipeline& pipeline) {
  while (!tool::interrupted()) {
    auto frame = std::make_unique<StereoFrame>();
    if (source.next(*frame, 0.0) == FrameSource::Grab::kEnd) {
      pipeline.drain();
      return true;
    }
    check_size(*frame, rig, recording.calibration);
    pipeline.push(std::move(frame));
  }
  pipeline.drain();
  return false;
}

}  // namespace mocap
}  // namespace anthrob
