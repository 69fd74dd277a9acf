#pragma once

#include <ros/ros.h>

#include <memory>

#include "anthrob_mocap/camera/stereo_rig.h"
#include "anthrob_mocap/source/frame_source.h"

namespace anthrob {
namespace mocap {

/// The source that the parameters of the node name: folder, bag, aravis or dc1394.
/// @throws BadInput
std::unique_ptr<FrameSource> open_source(const std::string& kind, const StereoRig& rig,
                                         const ros::NodeHandle& settings);

}  // namespace mocap
}  // namespace anthrob
