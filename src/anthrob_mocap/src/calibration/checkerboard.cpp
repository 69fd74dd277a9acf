#include "calibration/checkerboard.h"

#include <algorithm>
#include <cstdio>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace mocap {

Board Board::parse(const std::string& size, double square) {
  Board board;
  char rest = 0;
  if (std::sscanf(size.c_str(), "%dx%d%c", &board.columns, &board.rows, &rest) != 2 ||
      board.columns < 3 || board.rows < 3 || board.columns == board.rows) {
    throw BadInput("--board " + size +
                   ": expected the inner corners as COLUMNSxROWS, both at least 3 and different (a "
                   "square board can be read in four ways)");
  }
  if (!(square > 0.0 && square < 1.0)) {
    throw BadInput("--square " + std::to_string(square) +
                   ": expected the edge of a square in metres, above 0 and below 1");
  }
  board.square = square;
  return board;
}

std::vector<Vec3> Board::points() const {
  std::vector<Vec3> result;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) result.emplace_back(c * square, r * square, 0.0);
  }
  return result;
}

std::optional<std::vector<Vec2>> find_corners(const Image& image, const Board& board) {
  const cv::Mat grey(image.height, image.width, CV_8U,
                     const_cast<std::uint8_t*>(image.pixels.data()));
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCorners(grey, {board.columns, board.rows}, corners,
                                 cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE)) {
    return std::nullopt;
  }
  // The search window must stay within the squares around a corner, even if the board is slanted.
  const std::size_t columns = static_cast<std::size_t>(board.columns);
  float shortest = 1e9f;
  const auto limit = [&](const cv::Point2f& a, const cv::Point2f& b) {
    shortest = std::min(shortest, static_cast<float>(cv::norm(a - b)));
  };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i % columns != 0) limit(corners[i], corners[i - 1]);
    if (i >= columns) limit(corners[i], corners[i - columns]);
  }
  const int half = std::clamp(static_cast<int>(0.45f * shortest), 2, 11);
  cv::cornerSubPix(grey, corners, {half, half}, {-1, -1},
                   {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-3});
  std::vector<Vec2> result;
  for (const cv::Point2f& corner : corners) result.emplace_back(corner.x, corner.y);
  return result;
}

void same_direction(const std::vector<Vec2>& left, std::vector<Vec2>& right) {
  if ((left.back() - left.front()).dot(right.back() - right.front()) < 0.0) {
    std::reverse(right.begin(), right.end());
  }
}

}  // namespace mocap
}  // namespace anthrob
