#pragma once

#include <unistd.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <memory>
#include <random>

#include "calibration/rectification.h"
#include "pipeline/tracker.h"
#include "render/renderer.h"

namespace anthrob {
namespace mocap {
namespace test {

constexpr double kDegree = M_PI / 180.0;

/// What this process has of the machine's memory.
inline double resident_bytes() {
  std::ifstream in("/proc/self/statm");
  long size = 0, resident = 0;
  in >> size >> resident;
  return static_cast<double>(resident * sysconf(_SC_PAGESIZE));
}

/// Like the thesis's cameras: 648x488 pixels, 6 mm lens, turned towards each other.
inline StereoRig make_rig(double toe_in = 5.0 * kDegree) {
  CameraModel camera;
  camera.name = "camera";
  camera.width = 648, camera.height = 488;
  camera.fx = 1071.0, camera.fy = 1070.0, camera.cx = 322.0, camera.cy = 245.5;
  camera.distortion = {-0.24, 0.11, 0.0006, -0.0004, 0.0, 0.0, 0.0, 0.0};
  CameraModel right = camera;
  right.fx = 1069.0, right.fy = 1069.5, right.cx = 326.5, right.cy = 241.0;
  right.distortion = {-0.25, 0.12, -0.0003, 0.0005, 0.0, 0.0, 0.0, 0.0};
  Pose X_RL;
  X_RL.R = exp_rotation({0.004, 2.0 * toe_in, -0.006});
  // The right camera's centre lies 0.3 m to the right of the left one, seen along the mean view.
  X_RL.p = -(X_RL.R * (exp_rotation({0.0, -toe_in, 0.0}) * Vec3(0.3, 0.001, 0.0)));
  return rectify_pair(camera, right, X_RL);
}

inline TargetSet make_targets() {
  TargetSet set;
  set.marker_diameter = 0.016;
  set.targets = {{"scapula",
                  {{0.044, -0.064, 0.403},
                   {0.094, -0.024, 0.482},
                   {0.135, -0.137, 0.423},
                   {0.052, -0.09, 0.46},
                   {0.072, -0.178, 0.554}}},
                 {"humerus",
                  {{-0.06, 0.033, 0.026},
                   {-0.024, 0.177, 0.078},
                   {-0.053, 0.078, 0.023},
                   {0.058, 0.172, 0.066},
                   {0.022, 0.186, 0.023}}}};
  for (MarkerTarget& target : set.targets) {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& m : target.markers) mean += m / 5.0;
    for (Vec3& m : target.markers) m -= mean;
  }
  set.joints = {{"shoulder", 0, 1, Quat::Identity(), Quat::Identity()}};
  return set;
}

/// Poses of the targets in the rectified left frame at an instant.
using Motion = std::function<std::vector<Pose>(double t)>;

/// Both targets in view, 1.1 m away.
inline std::vector<Pose> rest_poses() {
  Pose scapula{exp_rotation({-0.22, -1.58, -0.89}), {0.07, -0.08, 1.12}};
  Pose humerus{exp_rotation({0.19, -0.68, -2.82}), {0.22, 0.08, 1.10}};
  return {scapula, humerus};
}

/// The humerus turns to and fro by up to `amplitude` [rad], `rate` [rad/s] at most.
inline Motion swing(double amplitude, double rate) {
  return [=](double t) {
    std::vector<Pose> poses = rest_poses();
    const double angle = rate > 0.0 ? amplitude * std::sin(rate / amplitude * t) : 0.0;
    const Vec3 axis = Vec3(0.6, 0.3, 0.74).normalized();
    poses[1].R = exp_rotation(angle * axis) * poses[1].R;
    poses[1].p += 0.08 * std::sin(angle) * Vec3(-0.5, 0.6, 0.3);
    return poses;
  };
}

inline Scene scene_of(const TargetSet& set, const std::vector<Pose>& poses) {
  Scene scene;
  for (std::size_t k = 0; k < set.targets.size(); ++k) {
    for (const Vec3& m : set.targets[k].markers) {
      scene.spheres.push_back({poses[k] * m, 0.5 * set.marker_diameter, 180.0});
    }
  }
  return scene;
}

/// Reflections anywhere in view, of sizes like the markers'.
inline void add_distractors(Scene& scene, int count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> x(-0.1, 0.4), y(-0.22, 0.22), z(0.9, 1.4), r(0.003, 0.012);
  std::uniform_real_distribution<double> brightness(60.0, 200.0);
  for (int i = 0; i < count; ++i) {
    const Vec3 p(x(random), y(random), z(random));
    scene.spheres.push_back({p, r(random), brightness(random)});
  }
}

/// Renders and tracks one frame after the other.
class Session {
 public:
  explicit Session(const StereoRig& rig, const TargetSet& set, const RenderOptions& render = {},
                   const TrackerOptions& options = {})
      : renderer_(rig, render),
        pipeline_(tracking_stages(rig, set, options), PipelineMode::kSequential, 1,
                  [this](PacketPtr packet) { frame_ = std::move(packet); }) {}

  const StereoFrame& track(double t, const std::vector<Scene>& instants) {
    auto frame = std::make_unique<StereoFrame>();
    frame->t = t, frame->index = index_++;
    for (const Side side : {kLeft, kRight}) {
      renderer_.render(side, instants, frame->index, image_[side]);
      frame->image[side] = image_[side].view();
    }
    pipeline_.push(std::move(frame));
    return static_cast<const StereoFrame&>(*frame_);
  }

 private:
  Renderer renderer_;
  Image image_[2];
  std::uint64_t index_ = 0;
  PacketPtr frame_;
  Pipeline pipeline_;
};

}  // namespace test
}  // namespace mocap
}  // namespace anthrob
