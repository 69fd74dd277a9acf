#include "open_source.h"

#include "anthrob_mocap/source/aravis_source.h"
#include "anthrob_mocap/source/folder_source.h"
#include "bag_source.h"
#include "parameters.h"
#ifdef ANTHROB_HAVE_DC1394
#include "anthrob_mocap/source/dc1394_source.h"
#endif

namespace anthrob {
namespace mocap {

namespace {

CameraOptions camera_options(const StereoRig& rig, const ros::NodeHandle& settings) {
  CameraOptions options;
  options.name[kLeft] = required(settings, "left", "the name of the left camera");
  options.name[kRight] = required(settings, "right", "the name of the right camera");
  options.width = rig.width(), options.height = rig.height();
  settings.param("rate", options.rate, options.rate);
  settings.param("exposure", options.exposure, options.exposure);
  settings.param("trigger", options.trigger, options.trigger);
  const double tolerance = settings.param("sync_tolerance", 0.0);
  if (tolerance > 0.0) options.sync_tolerance = tolerance;
  return options;
}

}  // namespace

std::unique_ptr<FrameSource> open_source(const std::string& kind, const StereoRig& rig,
                                         const ros::NodeHandle& settings) {
  if (kind == "folder") {
    FolderSource::Options options;
    settings.param("rate", options.rate, options.rate);
    return std::make_unique<FolderSource>(required(settings, "left", "a folder of images"),
                                          required(settings, "right", "a folder of images"),
                                          options);
  }
  if (kind == "bag") {
    return std::make_unique<BagSource>(
        required(settings, "bag", "a bag file"), required(settings, "left", "an image topic"),
        required(settings, "right", "an image topic"), settings.param("sync_tolerance", 0.0));
  }
  if (kind == "aravis") return std::make_unique<AravisSource>(camera_options(rig, settings));
#ifdef ANTHROB_HAVE_DC1394
  if (kind == "dc1394") return std::make_unique<Dc1394Source>(camera_options(rig, settings));
#endif
  throw BadInput(
      "parameter ~source: " + kind +
      ": expected topics, folder, bag, aravis or (where libdc1394 was there at the build) "
      "dc1394");
}

}  // namespace mocap
}  // namespace anthrob
