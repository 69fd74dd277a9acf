#pragma once

#include <string>
#include <vector>

#include "calibration/checkerboard.h"
#include "camera/stereo_rig.h"

namespace anthrob {
namespace mocap {

/// Corners of one board in both cameras.
struct BoardView {
  std::string name;
  std::vector<Vec2> corners[2];
};

struct CalibrationLimits {
  int least_views = 8;
  double stereo_rms = 1.0;      ///< [pixel]
  double epipolar_rms = 1.0;    ///< [pixel]
  double least_coverage = 0.3;  ///< share of the picture in which corners were seen
  double least_tilt = 0.1745;   ///< [rad] see StereoCalibration
};

struct StereoCalibration {
  StereoRig rig;
  int views = 0;
  double camera_rms[2] = {0, 0};  ///< [pixel] reprojection, each camera alone
  double stereo_rms = 0.0;        ///< [pixel] reprojection, both together
  double epipolar_rms = 0.0;      ///< [pixel] between rows of rectified corners
  double square_rms = 0.0;        ///< [m] of triangulated edges of squares
  double coverage[2] = {0, 0};    ///< of the picture, in cells of an 8x6 grid
  double tilt =
      0.0;  ///< [rad] of the board against the picture; rms, of the camera where it is less
  std::vector<std::string> dropped = {};  ///< views left out because they do not fit

  /// For people, one finding a line.
  std::string report() const;
};

/// Calibrates a pair from views of a checkerboard [Zhang; OpenCV]: each camera alone, both
/// together; views that fit much worse than the rest are left out.
/// @throws BadInput if the result cannot be trusted: too few views, swapped or mirrored images,
///   residuals, coverage or tilt beyond the limits
StereoCalibration calibrate_stereo(const std::vector<BoardView>& views, const Board& board,
                                   int width, int height, const CalibrationLimits& limits);

}  // namespace mocap
}  // namespace anthrob
