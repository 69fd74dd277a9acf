#include "calibration/rectification.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

namespace anthrob {
namespace mocap {

namespace {

cv::Mat camera_matrix(const CameraModel& c) {
  return (cv::Mat_<double>(3, 3) << c.fx, 0.0, c.cx, 0.0, c.fy, c.cy, 0.0, 0.0, 1.0);
}

cv::Mat coefficients(const CameraModel& c) {
  return cv::Mat(1, static_cast<int>(c.distortion.size()), CV_64F,
                 const_cast<double*>(c.distortion.data()))
      .clone();
}

}  // namespace

StereoRig rectify_pair(CameraModel left, CameraModel right, const Pose& X_RL) {
  cv::Mat R, t, R_left, R_right, P_left, P_right, Q;
  cv::eigen2cv(X_RL.R, R);
  cv::eigen2cv(X_RL.p, t);
  cv::stereoRectify(camera_matrix(left), coefficients(left), camera_matrix(right),
                    coefficients(right), {left.width, left.height}, R, t, R_left, R_right, P_left,
                    P_right, Q, cv::CALIB_ZERO_DISPARITY, 0.0);
  cv::cv2eigen(R_left, left.R), cv::cv2eigen(R_right, right.R);
  cv::cv2eigen(P_left, left.P), cv::cv2eigen(P_right, right.P);
  return StereoRig(left, right);
}

}  // namespace mocap
}  // namespace anthrob
