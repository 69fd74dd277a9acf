#pragma once

#include <string>
#include <vector>

#include "labelling/targets.h"
#include "render/renderer.h"

namespace anthrob {
namespace mocap {

/// How cameras and targets are mounted on a robot (rig.yaml), and what a virtual rig adds to the
/// picture. Frames are those of tf.
struct Setup {
  struct Mount {
    std::string link;
    Pose X_LT;  ///< target in the link's frame
  };
  struct JointFrame {
    std::string parent, child;   ///< links
    Pose X_PC;                   ///< child in parent at rest
    Vec3 centre = Vec3::Zero();  ///< of rotation, in the child's frame [m]

    Pose at(const Quat& q) const;  ///< child in parent at rotation q from rest
  };

  std::string camera_parent;       ///< frame in which the cameras stand
  Pose X_PC;                       ///< rectified left frame in it
  std::vector<Mount> mounts;       ///< by target
  std::vector<JointFrame> joints;  ///< by joint

  double rate = 60.0;       ///< [Hz]
  double exposure = 3e-5;   ///< [s]
  int instants = 1;         ///< images summed for motion blur
  double brightness = 180;  ///< of markers [grey levels]
  RenderOptions render;
  std::vector<Sphere> distractors;  ///< reflections that stay in place, in the camera's frame

  /// @throws BadInput with file, line, key and reason; every target and joint must be there
  static Setup load(const std::string& file, const TargetSet& targets);
};

}  // namespace mocap
}  // namespace anthrob
