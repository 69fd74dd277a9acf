#pragma once

#include <ros/ros.h>

#include <functional>
#include <memory>
#include <string>

#include "camera/stereo_rig.h"
#include "source/frame_source.h"

namespace anthrob {
namespace mocap {

/// Opens the source that the parameters of the node name: folder, bag, aravis or dc1394.
/// @param refuse gets a message for each image that is left out
/// @throws BadInput if the kind is unknown, or a parameter is missing or out of range
std::unique_ptr<FrameSource> open_source(const std::string& kind, const StereoRig& rig,
                                         const ros::NodeHandle& settings,
                                         const std::function<void(const std::string& why)>& refuse);

}  // namespace mocap
}  // namespace anthrob
