#include "core/rigid_fit.h"

#include <Eigen/SVD>
#include <cmath>

namespace anthrob {
namespace mocap {

RigidFit fit_rigid(const PointPairs& pairs) {
  const double n = static_cast<double>(pairs.size());
  Vec3 mean_from = Vec3::Zero(), mean_to = Vec3::Zero();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    mean_from += pairs.from(i) / n, mean_to += pairs.to(i) / n;
  }
  Mat3 covariance = Mat3::Zero();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    covariance += (pairs.to(i) - mean_to) * (pairs.from(i) - mean_from).transpose();
  }
  const Eigen::JacobiSVD<Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 sign = Vec3::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) sign.z() = -1.0;
  RigidFit fit;
  fit.X.R = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  fit.X.p = mean_to - fit.X.R * mean_from;
  double squares = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    squares += (pairs.to(i) - fit.X * pairs.from(i)).squaredNorm();
  }
  fit.rms = std::sqrt(squares / n);
  return fit;
}

}  // namespace mocap
}  // namespace anthrob
