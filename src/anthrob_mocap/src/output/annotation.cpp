#include "output/annotation.h"

#include <opencv2/imgproc.hpp>

namespace anthrob {
namespace mocap {

namespace {

const cv::Scalar kYellow(0, 220, 220);
const cv::Scalar kTargetColours[] = {{80, 220, 60}, {60, 150, 255}, {255, 120, 200}};

cv::Point at(const Vec2& pixel, int offset) {
  return {cvRound(pixel.x()) + offset, cvRound(pixel.y())};
}

void draw_image(const ImageView& view, cv::Mat part) {
  const cv::Mat grey(view.height, view.width, CV_8U, const_cast<std::uint8_t*>(view.pixels),
                     view.stride);
  cv::cvtColor(grey, part, cv::COLOR_GRAY2BGR);
}

void draw_target(const StereoFrame& frame, std::size_t k, const StereoRig& rig,
                 const MarkerTarget& target, Side side, int offset, cv::Mat& canvas) {
  const cv::Scalar colour = kTargetColours[k % 3];
  for (std::size_t i = 0; i < target.markers.size(); ++i) {
    const Vec3 p = frame.targets[k].X * target.markers[i];
    const cv::Point expected = at(rig.project(side, p), offset);
    const int point = frame.labels[k].point[i];
    if (point < 0) {
      cv::drawMarker(canvas, expected, colour, cv::MARKER_TILTED_CROSS, 12, 1);
      continue;
    }
    const int blob = frame.points[static_cast<std::size_t>(point)].blob[side];
    const Blob& seen = frame.blobs[side][static_cast<std::size_t>(blob)];
    cv::circle(canvas, at(seen.centre, offset), cvRound(seen.radius()) + 3, colour, 2);
    cv::putText(canvas, target.name.substr(0, 1) + std::to_string(i),
                at(seen.centre, offset) + cv::Point(cvRound(seen.radius()) + 5, -5),
                cv::FONT_HERSHEY_SIMPLEX, 0.45, colour);
  }
}

}  // namespace

ColourImage annotate(const StereoFrame& frame, const StereoRig& rig, const TargetSet& set) {
  ColourImage image;
  const int width = frame.image[kLeft].width;
  image.width = 2 * width, image.height = frame.image[kLeft].height;
  image.pixels.resize(static_cast<std::size_t>(image.width * image.height) * 3);
  cv::Mat canvas(image.height, image.width, CV_8UC3, image.pixels.data());
  for (const Side side : {kLeft, kRight}) {
    const int offset = side == kLeft ? 0 : width;
    draw_image(frame.image[side], canvas(cv::Rect(offset, 0, width, image.height)));
    for (const Blob& blob : frame.blobs[side]) {
      cv::circle(canvas, at(blob.centre, offset), cvRound(blob.radius()) + 3, kYellow, 1);
    }
    for (std::size_t k = 0; k < frame.targets.size(); ++k) {
      if (frame.targets[k].valid) draw_target(frame, k, rig, set.targets[k], side, offset, canvas);
    }
  }
  return image;
}

}  // namespace mocap
}  // namespace anthrob
