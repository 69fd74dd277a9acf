#include "pose/pose_estimator.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace anthrob {
namespace mocap {

namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Row6 = Eigen::Matrix<double, 2, 6>;

constexpr double kPriorFreedom = 6.0;  // weight of the assumed pixel noise, in residuals
constexpr int kSteps = 2;              // the closed form starts within a tenth of a millimetre
constexpr double kSuspicious = 2.0;    // times the believed noise: look for a marker that is off
/// Smallest share of the largest eigenvalue of the normal equations. That of three markers on a
/// line is zero but for rounding; the covariance would be, too.
constexpr double kSingular = 1e-12;

/// Change of a rectified pixel with (p, turn) of the target, q = turn x R m + p in a camera.
Row6 jacobian(double focal, const Vec3& q, const Vec3& Rm) {
  Eigen::Matrix<double, 2, 3> projection;
  const double f_z = focal / q.z();
  projection << f_z, 0.0, -f_z * q.x() / q.z(), 0.0, f_z, -f_z * q.y() / q.z();
  Mat3 minus_cross;
  minus_cross << 0.0, Rm.z(), -Rm.y(), -Rm.z(), 0.0, Rm.x(), Rm.y(), -Rm.x(), 0.0;
  Row6 J;
  J << projection, projection * minus_cross;
  return J;
}

bool is_singular(const Mat6& H) {
  const Eigen::SelfAdjointEigenSolver<Mat6> solver(H, Eigen::EigenvaluesOnly);
  const Vec6 values = solver.eigenvalues();  // in increasing order
  return solver.info() != Eigen::Success || !(values[0] > kSingular * values[5]);
}

}  // namespace

TargetPose PoseEstimator::estimate(int target, const Labelling& labelling,
                                   const std::vector<MarkerPoint>& points) const {
  TargetPose pose;
  if (labelling.count < 3) return pose;
  Observations markers;
  for (std::size_t i = 0; i < labelling.point.size(); ++i) {
    const int point = labelling.point[i];
    if (point < 0) continue;
    markers.list[markers.count++] = {targets_[static_cast<std::size_t>(target)].markers[i],
                                     &points[static_cast<std::size_t>(point)]};
  }
  pose.X = labelling.fit.X;
  Normal normal = refine(markers, pose.X);
  while (markers.count > 3 &&
         pixel_rms(normal, markers.count) > kSuspicious * options_.pixel_noise) {
    Observations fewer = markers;
    fewer.list[normal.worst] = fewer.list[--fewer.count];
    Pose X = pose.X;
    const Normal without = refine(fewer, X);
    // Leaving out four residuals of noise alone lowers the rms by less than half.
    if (pixel_rms(without, fewer.count) > 0.5 * pixel_rms(normal, markers.count)) break;
    markers = fewer, normal = without, pose.X = X;
  }
  describe(markers, normal, pose);
  return pose;
}

PoseEstimator::Normal PoseEstimator::normal_equations(const Observations& markers,
                                                      const Pose& X) const {
  Normal normal{Mat6::Zero(), Vec6::Zero(), 0.0, 0};
  double largest = -1.0;
  for (int i = 0; i < markers.count; ++i) {
    const Vec3 Rm = X.R * markers.list[i].marker, p = Rm + X.p;
    double squares = 0.0;
    for (const Side side : {kLeft, kRight}) {
      const Vec3 q = side == kLeft ? p : Vec3(p - Vec3(rig_.baseline(), 0.0, 0.0));
      const Vec2 miss = markers.list[i].seen->image[side] - rig_.project_rectified(side, p);
      const Row6 J = jacobian(rig_.focal(), q, Rm);
      normal.H += J.transpose() * J;
      normal.g += J.transpose() * miss;
      squares += miss.squaredNorm();
    }
    normal.squares += squares;
    if (squares > largest) largest = squares, normal.worst = i;
  }
  return normal;
}

PoseEstimator::Normal PoseEstimator::refine(const Observations& markers, Pose& X) const {
  Normal normal = normal_equations(markers, X);
  for (int step = 0; step < kSteps; ++step) {
    const Vec6 d = normal.H.ldlt().solve(normal.g);
    X.p += d.head<3>();
    X.R = exp_rotation(d.tail<3>()) * X.R;
    normal = normal_equations(markers, X);
  }
  return normal;
}

double PoseEstimator::pixel_rms(const Normal& normal, int markers) const {
  return std::sqrt(normal.squares / (4.0 * markers)) / rig_.zoom();
}

void PoseEstimator::describe(const Observations& markers, const Normal& normal,
                             TargetPose& pose) const {
  pose.markers = markers.count;
  double squares = 0.0;
  for (int i = 0; i < markers.count; ++i) {
    const MarkerPoint& seen = *markers.list[i].seen;
    squares += (seen.p - pose.X * markers.list[i].marker).squaredNorm();
    pose.row_error +=
        (seen.image[kLeft].y() - seen.image[kRight].y()) / (pose.markers * rig_.zoom());
  }
  pose.rms = std::sqrt(squares / pose.markers);
  pose.pixel_rms = pixel_rms(normal, markers.count);
  // Residuals beyond the six unknowns tell the noise; the assumed noise completes them.
  const double believed = std::pow(options_.pixel_noise * rig_.zoom(), 2);
  const double freedom = 4.0 * pose.markers - 6.0;
  const double variance = (kPriorFreedom * believed + normal.squares) / (kPriorFreedom + freedom);
  if (!pose.X.p.allFinite() || !pose.X.R.allFinite() || is_singular(normal.H)) return;
  pose.covariance = variance * normal.H.ldlt().solve(Mat6::Identity());
  const Eigen::SelfAdjointEigenSolver<Mat3> turn(pose.covariance.bottomRightCorner<3, 3>(),
                                                 Eigen::EigenvaluesOnly);
  pose.valid = turn.eigenvalues().maxCoeff() <= std::pow(options_.max_turn_sigma, 2);
}

}  // namespace mocap
}  // namespace anthrob
