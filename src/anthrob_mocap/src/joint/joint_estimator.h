#pragma once

#include <vector>

#include "labelling/targets.h"
#include "pose/pose_estimator.h"

namespace anthrob {
namespace mocap {

/// State of a ball joint: rotation from rest in the child's axes.
struct JointEstimate {
  bool valid = false;
  Quat q = Quat::Identity();
  Mat3 covariance = Mat3::Zero();  ///< of the rotation, in the child's axes [rad^2]
  bool velocity_valid = false;     ///< false for the first picture after a gap
  Vec3 velocity = Vec3::Zero();    ///< child relative to parent, in the child's axes [rad/s]
  Mat3 velocity_covariance = Mat3::Zero();  ///< [rad^2/s^2]
};

/// Joint orientation from two targets, (A.4), and its angular velocity. The velocity is the slope,
/// at the latest picture, of a parabola through the last orientations, taken as rotation vectors
/// relative to the latest. Unlike a plain difference, a parabola has no lag under constant
/// acceleration. After a gap or a step back in time, the estimator starts over.
class JointEstimator {
 public:
  static constexpr std::size_t kWindow = 6;   ///< pictures
  static constexpr double kLongestGap = 0.1;  ///< [s]

  explicit JointEstimator(const BallJoint& joint) : joint_(joint) {}

  const BallJoint& joint() const { return joint_; }
  JointEstimate estimate(double t, const TargetPose& parent, const TargetPose& child);

 private:
  struct Sample {
    double t;
    Mat3 R;
  };
  void estimate_velocity(JointEstimate& estimate) const;

  BallJoint joint_;
  Sample samples_[kWindow];  ///< the latest last
  std::size_t count_ = 0;
};

}  // namespace mocap
}  // namespace anthrob
