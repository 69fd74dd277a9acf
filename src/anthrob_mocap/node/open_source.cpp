#include "open_source.h"

#include "anthrob_core/errors.h"
#include "anthrob_ros/parameters.h"
#include "bag_source.h"
#include "source/aravis_source.h"
#include "source/folder_source.h"
#ifdef ANTHROB_HAVE_DC1394
#include "source/dc1394_source.h"
#endif

namespace anthrob {
namespace mocap {

namespace {

/// 0 if it is not there
double sync_tolerance(const ros::NodeHandle& settings) {
  double tolerance = 0.0;
  take(settings, "sync_tolerance", nonnegative_number_of, tolerance);
  return tolerance;
}

CameraOptions camera_options(const StereoRig& rig, const ros::NodeHandle& settings) {
  CameraOptions options;
  options.name[kLeft] = required(settings, "left", "the name of the left camera");
  options.name[kRight] = required(settings, "right", "the name of the right camera");
  options.width = rig.width(), options.height = rig.height();
  take(settings, "rate", number_of, options.rate);
  take(settings, "exposure", number_of, options.exposure);
  take(settings, "trigger", text_of, options.trigger);
  options.sync_tolerance = sync_tolerance(settings);
  return options;
}

}  // namespace

std::unique_ptr<FrameSource> open_source(
    const std::string& kind, const StereoRig& rig, const ros::NodeHandle& settings,
    const std::function<void(const std::string& why)>& refuse) {
  if (kind == "folder") {
    FolderSource::Options options;
    take(settings, "rate", positive_number_of, options.rate);
    const double tolerance = sync_tolerance(settings);
    if (tolerance > 0.0) options.sync_tolerance = tolerance;
    auto folder =
        std::make_unique<FolderSource>(required(settings, "left", "a folder of images"),
                                       required(settings, "right", "a folder of images"), options);
    if (folder->assumption()) ROS_WARN_STREAM("mocap: " << *folder->assumption());
    if (folder->loss()) ROS_WARN_STREAM("mocap: " << *folder->loss());
    return folder;
  }
  if (kind == "bag") {
    return std::make_unique<BagSource>(
        required(settings, "bag", "a bag file"), required(settings, "left", "an image topic"),
        required(settings, "right", "an image topic"), sync_tolerance(settings), refuse);
  }
  if (kind == "aravis") return std::make_unique<AravisSource>(camera_options(rig, settings));
#ifdef ANTHROB_HAVE_DC1394
  if (kind == "dc1394") return std::make_unique<Dc1394Source>(camera_options(rig, settings));
#endif
  throw BadInput(
      "parameter ~source: " + kind +
      ": expected topics, folder, bag, aravis or dc1394 (the last only if libdc1394 was installed "
      "at build time)");
}

}  // namespace mocap
}  // namespace anthrob
