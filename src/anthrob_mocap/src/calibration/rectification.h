#pragma once

#include "camera/stereo_rig.h"

namespace anthrob {
namespace mocap {

/// The pair of two cameras with R and P filled in, so that rows correspond [Bouguet's method].
/// @param left, right  with image size, pinhole and lens
/// @param X_RL  a point in the left camera's frame to the right's
StereoRig rectify_pair(CameraModel left, CameraModel right, const Pose& X_RL);

}  // namespace mocap
}  // namespace anthrob
