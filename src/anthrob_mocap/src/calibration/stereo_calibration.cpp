#include "calibration/stereo_calibration.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "anthrob_core/errors.h"
#include "calibration/rectification.h"

namespace anthrob {
namespace mocap {

namespace {

constexpr int kGridColumns = 8, kGridRows = 6;
constexpr double kOutlier = 3.0;  // times the median error of views

using Points2 = std::vector<std::vector<cv::Point2f>>;
using Points3 = std::vector<std::vector<cv::Point3f>>;

/// What OpenCV works on.
struct Problem {
  cv::Size size;
  Points3 board;
  Points2 corners[2];
  cv::Mat K[2], D[2], R, t, view_errors;
  double camera_rms[2] = {0, 0};  ///< [pixel]
  double tilt[2] = {0, 0};        ///< [rad] root mean square over the views
};

Problem make_problem(const std::vector<BoardView>& views, const Board& board, int width,
                     int height) {
  Problem problem;
  problem.size = {width, height};
  std::vector<cv::Point3f> points;
  for (const Vec3& p : board.points()) {
    points.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0f);
  }
  for (const BoardView& view : views) {
    problem.board.push_back(points);
    for (const Side side : {kLeft, kRight}) {
      problem.corners[side].emplace_back();
      for (const Vec2& c : view.corners[side]) {
        problem.corners[side].back().emplace_back(static_cast<float>(c.x()),
                                                  static_cast<float>(c.y()));
      }
    }
  }
  return problem;
}

/// @param turns of the board in the camera   @return root mean square of its tilt [rad]
double tilt_of(const std::vector<cv::Mat>& turns) {
  double squares = 0.0;
  for (const cv::Mat& turn : turns) {
    cv::Mat R;
    cv::Rodrigues(turn, R);
    squares += std::pow(std::acos(std::min(1.0, std::abs(R.at<double>(2, 2)))), 2);
  }
  return std::sqrt(squares / static_cast<double>(turns.size()));
}

/// @return stereo reprojection error [pixel]
double solve(Problem& p) {
  for (const Side side : {kLeft, kRight}) {
    std::vector<cv::Mat> rvecs, tvecs;
    p.camera_rms[side] = cv::calibrateCamera(p.board, p.corners[side], p.size, p.K[side], p.D[side],
                                             rvecs, tvecs, cv::CALIB_FIX_K3);
    p.tilt[side] = tilt_of(rvecs);
  }
  cv::Mat E, F;
  return cv::stereoCalibrate(p.board, p.corners[kLeft], p.corners[kRight], p.K[kLeft], p.D[kLeft],
                             p.K[kRight], p.D[kRight], p.size, p.R, p.t, E, F, p.view_errors,
                             cv::CALIB_USE_INTRINSIC_GUESS | cv::CALIB_FIX_K3,
                             {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-9});
}

double view_error(const Problem& p, int view) {
  return std::max(p.view_errors.at<double>(view, 0), p.view_errors.at<double>(view, 1));
}

/// Moves views that fit far worse than the median to `dropped`.
bool drop_outliers(const Problem& p, std::vector<BoardView>& views,
                   std::vector<std::string>& dropped) {
  std::vector<double> errors;
  for (int i = 0; i < p.view_errors.rows; ++i) errors.push_back(view_error(p, i));
  std::vector<double> sorted = errors;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                   sorted.end());
  const double limit = kOutlier * sorted[sorted.size() / 2];
  std::vector<BoardView> kept;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (errors[i] > limit)
      dropped.push_back(views[i].name);
    else
      kept.push_back(views[i]);
  }
  const bool changed = kept.size() < views.size();
  views = kept;
  return changed;
}

CameraModel camera_of(const Problem& p, Side side) {
  CameraModel camera;
  camera.name = name(side);
  camera.width = p.size.width, camera.height = p.size.height;
  camera.fx = p.K[side].at<double>(0, 0), camera.fy = p.K[side].at<double>(1, 1);
  camera.cx = p.K[side].at<double>(0, 2), camera.cy = p.K[side].at<double>(1, 2);
  for (int i = 0; i < 5; ++i)
    camera.distortion[static_cast<std::size_t>(i)] = p.D[side].at<double>(i);
  return camera;
}

double coverage(const std::vector<BoardView>& views, Side side, const cv::Size& size) {
  std::vector<char> seen(kGridColumns * kGridRows, 0);
  for (const BoardView& view : views) {
    for (const Vec2& c : view.corners[side]) {
      const int column = static_cast<int>(c.x() * kGridColumns / size.width);
      const int row = static_cast<int>(c.y() * kGridRows / size.height);
      if (column < 0 || row < 0 || column >= kGridColumns || row >= kGridRows) continue;
      seen[static_cast<std::size_t>(row * kGridColumns + column)] = 1;
    }
  }
  return static_cast<double>(std::count(seen.begin(), seen.end(), 1)) /
         static_cast<double>(seen.size());
}

void check_geometry(const std::vector<BoardView>& views, const Board& board,
                    StereoCalibration& result) {
  double rows = 0.0, squares = 0.0;
  int corners = 0, edges = 0;
  for (const BoardView& view : views) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < view.corners[kLeft].size(); ++i) {
      const Vec2 left = result.rig.rectify(kLeft, view.corners[kLeft][i]);
      const Vec2 right = result.rig.rectify(kRight, view.corners[kRight][i]);
      rows += std::pow((left.y() - right.y()) / result.rig.zoom(), 2), ++corners;
      points.push_back(result.rig.triangulate(left, right));
      if (i % static_cast<std::size_t>(board.columns) == 0) continue;
      squares += std::pow((points[i] - points[i - 1]).norm() - board.square, 2), ++edges;
    }
  }
  result.epipolar_rms = std::sqrt(rows / corners);
  result.square_rms = std::sqrt(squares / edges);
}

std::string text(double value, int digits) {
  char buffer[32];
  std::snprintf(buffer, sizeof(buffer), "%.*f", digits, value);
  return buffer;
}

void check_limits(const StereoCalibration& result, const CalibrationLimits& limits) {
  // Of boards parallel to the picture, a longer lens and a larger distance look the same: all
  // residuals are small then, and depths wrong.
  if (!(result.tilt >= limits.least_tilt)) {
    throw BadInput("calibration: the board is tilted by " + text(result.tilt * kDegrees, 1) +
                   " degrees rms: expected at least " + text(limits.least_tilt * kDegrees, 0) +
                   "; tilt it by 20 to 40 degrees in different directions, and vary its distance");
  }
  if (!(result.stereo_rms <= limits.stereo_rms)) {
    throw BadInput(
        "calibration: reprojection error " + text(result.stereo_rms, 2) +
        " pixel: expected at most " + text(limits.stereo_rms, 2) +
        "; check that the pairs are synchronised, the board is flat and no image is mirrored");
  }
  if (!(result.epipolar_rms <= limits.epipolar_rms)) {
    throw BadInput("calibration: epipolar error " + text(result.epipolar_rms, 2) +
                   " pixel: expected at most " + text(limits.epipolar_rms, 2));
  }
  for (const Side side : {kLeft, kRight}) {
    if (result.coverage[side] >= limits.least_coverage) continue;
    throw BadInput("calibration: the board covers " + text(100.0 * result.coverage[side], 0) +
                   " % of the " + name(side) + " picture: expected at least " +
                   text(100.0 * limits.least_coverage, 0) +
                   " %; take views with the board near the corners of the picture");
  }
}

}  // namespace

StereoCalibration calibrate_stereo(const std::vector<BoardView>& all, const Board& board, int width,
                                   int height, const CalibrationLimits& limits) {
  std::vector<BoardView> views = all;
  std::vector<std::string> dropped;
  Problem problem;
  double stereo_rms = 0.0;
  do {
    if (static_cast<int>(views.size()) < limits.least_views) {
      throw BadInput("calibration: " + std::to_string(views.size()) + " usable views" +
                     (dropped.empty()
                          ? ""
                          : " (" + std::to_string(dropped.size()) + " do not fit the others)") +
                     ": expected at least " + std::to_string(limits.least_views));
    }
    problem = make_problem(views, board, width, height);
    stereo_rms = solve(problem);
  } while (drop_outliers(problem, views, dropped));

  Pose X_RL;
  cv::cv2eigen(problem.R, X_RL.R);
  cv::cv2eigen(problem.t, X_RL.p);
  const double x = -(X_RL.R.transpose() * X_RL.p).x();
  if (!(x > 0.0)) {
    throw BadInput(
        "calibration: the right camera comes out " + text(-1e3 * x, 1) +
        " mm to the left of the left one: the folders are swapped or the images mirrored; swap the "
        "folders only if they are, and never flip pictures (flips that keep left and right, such "
        "as upside down, are not noticed here)");
  }
  StereoCalibration result{
      rectify_pair(camera_of(problem, kLeft), camera_of(problem, kRight), X_RL)};
  result.views = static_cast<int>(views.size());
  result.dropped = dropped;
  result.stereo_rms = stereo_rms;
  result.tilt = std::min(problem.tilt[kLeft], problem.tilt[kRight]);
  for (const Side side : {kLeft, kRight}) {
    result.camera_rms[side] = problem.camera_rms[side];
    result.coverage[side] = coverage(views, side, problem.size);
  }
  check_geometry(views, board, result);
  check_limits(result, limits);
  return result;
}

std::string StereoCalibration::report() const {
  std::string lines = "views              " + std::to_string(views) + "\n";
  if (!dropped.empty()) {
    lines += "left out           ";
    for (const std::string& view : dropped) lines += view + " ";
    lines += "(they fit far worse than the others)\n";
  }
  lines += "reprojection       " + text(stereo_rms, 3) + " pixel rms (left alone " +
           text(camera_rms[kLeft], 3) + ", right alone " + text(camera_rms[kRight], 3) + ")\n";
  lines += "epipolar error     " + text(epipolar_rms, 3) + " pixel rms\n";
  lines += "edges of squares   " + text(1e3 * square_rms, 3) + " mm rms error\n";
  lines += "tilt of the board  " + text(tilt * kDegrees, 0) + " degrees rms\n";
  lines += "coverage           left " + text(100.0 * coverage[kLeft], 0) + " %, right " +
           text(100.0 * coverage[kRight], 0) + " %\n";
  lines += "baseline           " + text(1e3 * rig.baseline(), 2) + " mm\n";
  return lines;
}

}  // namespace mocap
}  // namespace anthrob
