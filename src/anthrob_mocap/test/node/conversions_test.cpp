// Calibrations from topics are refused as those from files are.
#include "conversions.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "expect_bad_input.h"
#include "support.h"

namespace anthrob {
namespace mocap {
namespace {

TEST(CameraInfo, ComesBackAsItWas) {
  const CameraModel camera = test::make_rig().camera(kRight);
  const CameraModel again = camera_model(camera_info(camera), kRight);
  EXPECT_EQ(again.fx, camera.fx);
  EXPECT_EQ(again.cy, camera.cy);
  EXPECT_EQ(again.distortion, camera.distortion);
  EXPECT_EQ(again.R, camera.R);
  EXPECT_EQ(again.P, camera.P);
}

TEST(CameraInfo, ThatIsNoCalibrationIsRefused) {
  using Info = sensor_msgs::CameraInfo;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refuse = [](const std::function<void(Info&)>& spoil, const std::string& part) {
    Info info = camera_info(test::make_rig().camera(kLeft));
    spoil(info);
    test::expect_bad_input([&] { camera_model(info, kLeft); }, "left camera_info: " + part);
  };
  refuse([](Info& i) { i.K[0] = 0.0; }, "the camera is not calibrated");
  for (const int place : {0, 4, 8}) {
    refuse([&](Info& i) { i.K[static_cast<std::size_t>(place)] = -1.0; }, "K: expected [fx,");
    refuse([&](Info& i) { i.K[static_cast<std::size_t>(place)] = nan; }, "K: expected [fx,");
  }
  refuse([](Info& i) { i.K[1] = 0.5; }, "K: expected [fx,");
  refuse([](Info& i) { i.distortion_model = "equidistant"; }, "distortion_model equidistant");
  refuse([](Info& i) { i.D.resize(3); }, "D: expected 4, 5 or 8 numbers");
  refuse([&](Info& i) { i.D[0] = nan; }, "D: expected 4, 5 or 8 numbers");
  refuse([](Info& i) { i.width = 0; }, "width, height");
  refuse([](Info& i) { i.R[0] = -i.R[0]; }, "R: expected a rotation");
  refuse([&](Info& i) { i.R[8] = nan; }, "R: expected a rotation");
  // A picture that was made narrower: one focal length for both axes is wrong then.
  refuse([](Info& i) { i.P[0] *= 0.5; }, "P: expected a rectified camera");
  refuse([&](Info& i) { i.P[3] = nan; }, "P: expected a rectified camera");
}

}  // namespace
}  // namespace mocap
}  // namespace anthrob
