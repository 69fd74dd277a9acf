#include "joint/joint_estimator.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace anthrob {
namespace mocap {

JointEstimate JointEstimator::estimate(double t, const TargetPose& parent,
                                       const TargetPose& child) {
  JointEstimate result;
  if (!parent.valid || !child.valid) return result;
  const Mat3 mount = joint_.child_mount.toRotationMatrix();
  const Mat3 R = joint_.rest.toRotationMatrix().transpose() * parent.X.R.transpose() * child.X.R *
                 mount.transpose();
  result.valid = true;
  result.q = canonical(Quat(R));
  const Mat3 to_bone = mount * child.X.R.transpose();
  result.covariance =
      to_bone *
      (parent.covariance.bottomRightCorner<3, 3>() + child.covariance.bottomRightCorner<3, 3>()) *
      to_bone.transpose();
  if (count_ > 0) {
    const double gap = t - samples_[count_ - 1].t;
    if (gap <= 0.0 || gap > kLongestGap) count_ = 0;
  }
  if (count_ == kWindow) {
    std::move(samples_ + 1, samples_ + kWindow, samples_);
    --count_;
  }
  samples_[count_++] = {t, R};
  if (count_ >= 2) estimate_velocity(result);
  return result;
}

void JointEstimator::estimate_velocity(JointEstimate& estimate) const {
  // Two or three pictures carry a straight line only.
  const int order = count_ >= 4 ? 2 : 1;
  const Sample& now = samples_[count_ - 1];
  Mat3 A = Mat3::Identity();
  A.topLeftCorner(order + 1, order + 1).setZero();
  Mat3 b = Mat3::Zero();  // row: coefficient, column: axis
  for (std::size_t k = 0; k < count_; ++k) {
    const double t = samples_[k].t - now.t;
    Vec3 basis(1.0, t, order == 2 ? t * t : 0.0);
    const Vec3 turn = log_rotation(now.R.transpose() * samples_[k].R);
    A.topLeftCorner(order + 1, order + 1) +=
        (basis * basis.transpose()).topLeftCorner(order + 1, order + 1);
    b += basis * turn.transpose();
  }
  const Mat3 inverse = A.inverse();
  estimate.velocity = (inverse * b).row(1).transpose();
  estimate.velocity_covariance = inverse(1, 1) * estimate.covariance;
  estimate.velocity_valid = true;
}

}  // namespace mocap
}  // namespace anthrob
