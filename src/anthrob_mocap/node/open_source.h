#pragma once

#include <ros/ros.h>

#include <functional>
#include <memory>
#include <string>

#include "anthrob_mocap/camera/stereo_rig.h"
#include "anthrob_mocap/source/frame_source.h"

namespace anthrob {
namespace mocap {

/// The source that the parameters of the node name: folder, bag, aravis or dc1394.
/// @param refuse is told of images that are left out
/// @throws BadInput
std::unique_ptr<FrameSource> open_source(const std::string& kind, const StereoRig& rig,
                                         const ros::NodeHandle& settings,
                                         const std::function<void(const std::string& why)>& refuse);

}  // namespace mocap
}  // namespace anthrob
