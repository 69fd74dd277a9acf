#include "recording.h"

#include "anthrob_core/command_line.h"
#include "anthrob_core/errors.h"

namespace anthrob {
namespace mocap {

namespace {

/// Says which image is not as large as calibrated; none if both are.
std::optional<std::string> size_fault(const StereoFrame& frame, const StereoRig& rig,
                                      const std::string& calibration) {
  for (const auto side : {kLeft, kRight}) {
    const ImageView& image = frame.image[side];
    if (image.width == rig.width() && image.height == rig.height()) continue;
    return frame.file[side] + ": " + std::to_string(image.width) + "x" +
           std::to_string(image.height) + " pixels: expected " + std::to_string(rig.width()) + "x" +
           std::to_string(rig.height()) + ", as in " + calibration;
  }
  return std::nullopt;
}

}  // namespace

void LeftOut::add(const std::string& why) {
  if (count_++ == 0) first_ = why;
  const double most = FolderSource::kMostFaults * static_cast<double>(pairs_);
  if (static_cast<double>(count_) <= most) return;
  throw BadInput(first_ + "; " + std::to_string(count_) + " or more of " + std::to_string(pairs_) +
                 " pairs cannot be used: expected at most a tenth");
}

std::optional<std::string> LeftOut::warning() const {
  if (count_ == 0) return std::nullopt;
  return std::to_string(count_) + " of " + std::to_string(pairs_) +
         " pairs cannot be used and were left out; the first: " + first_;
}

void Recording::add_options(CLI::App& app) {
  app.add_option("--left", left, "folder of images 000000.png, ..., 8-bit grey")->required();
  app.add_option("--right", right, "the same for the right camera")->required();
  app.add_option("--calibration", calibration, "folder with left.yaml and right.yaml")->required();
  app.add_option(
         "--sync-tolerance", folder.sync_tolerance,
         "[s] largest difference between the times of a pair, if each folder has its own times.csv")
      ->check(tool::within(0.0, 10.0));
}

void Recording::refuse_contradiction(const Health& health) const {
  if (const auto why = health.contradiction()) throw BadInput(left + ", " + right + ": " + *why);
}

bool track_all(FolderSource& source, const StereoRig& rig, const Recording& recording,
               Pipeline& pipeline, LeftOut& left_out) {
  while (!tool::interrupted()) {
    auto frame = std::make_unique<StereoFrame>();
    if (source.next(*frame, 0.0) == FrameSource::Grab::kEnd) {
      pipeline.drain();
      return true;
    }
    if (!frame->fault) {
      if (const auto fault = size_fault(*frame, rig, recording.calibration)) {
        frame->leave_out(*fault);
      }
    }
    if (frame->fault) left_out.add(*frame->fault);
    pipeline.push(std::move(frame));
  }
  pipeline.drain();
  return false;
}

}  // namespace mocap
}  // namespace anthrob
