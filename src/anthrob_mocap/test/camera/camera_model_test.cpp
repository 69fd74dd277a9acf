// Camera and rig: the lens against OpenCV's, the files against what must be refused.
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <random>

#include "expect_bad_input.h"
#include "support.h"
#include "temporary_folder.h"

namespace anthrob {
namespace mocap {
namespace {

using test::expect_bad_input;
using test::make_rig;
using test::replaced;
using test::TemporaryFolder;

CameraModel rational_camera() {
  CameraModel camera = make_rig().camera(kLeft);
  camera.distortion = {-0.3, 0.2, 0.001, -0.002, 0.05, 0.02, 0.1, 0.03};
  return camera;
}

TEST(CameraModel, ProjectsAsOpenCv) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> lateral(-0.3, 0.3), depth(0.8, 2.0);
  for (const CameraModel& camera : {make_rig().camera(kLeft), rational_camera()}) {
    const cv::Mat K =
        (cv::Mat_<double>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
    const std::vector<double> D(camera.distortion.begin(), camera.distortion.end());
    for (int i = 0; i < 200; ++i) {
      const Vec3 p(lateral(random), lateral(random), depth(random));
      std::vector<cv::Point2d> expected;
      cv::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, cv::Vec3d(), cv::Vec3d(),
                        K, D, expected);
      const Vec2 pixel = camera.project(p);
      EXPECT_NEAR(pixel.x(), expected[0].x, 1e-9);
      EXPECT_NEAR(pixel.y(), expected[0].y, 1e-9);
      EXPECT_NEAR((camera.ideal(pixel) - p.head<2>() / p.z()).norm(), 0.0, 1e-10);
    }
  }
}

TEST(CameraModel, HasNoInverseBeyondTheFold) {
  CameraModel camera = make_rig().camera(kLeft);
  camera.distortion = {-0.9, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  EXPECT_FALSE(camera.undistort({3.0, 0.0}).allFinite());
}

TEST(StereoRig, SeesPointsOnCommonRows) {
  const StereoRig rig = make_rig();
  EXPECT_NEAR(rig.baseline(), 0.3, 1e-4);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> x(-0.1, 0.4), y(-0.2, 0.2), z(0.8, 1.5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p(x(random), y(random), z(random));
    const Vec2 left = rig.rectify(kLeft, rig.project(kLeft, p));
    const Vec2 right = rig.rectify(kRight, rig.project(kRight, p));
    EXPECT_NEAR(left.y(), right.y(), 1e-6);
    EXPECT_NEAR((left - rig.project_rectified(kLeft, p)).norm(), 0.0, 1e-6);
    EXPECT_NEAR((rig.triangulate(left, right) - p).norm(), 0.0, 1e-9);
  }
}

TEST(StereoRig, TriangulatesOptimally) {
  // Against Hartley's and Sturm's polynomial.
  const StereoRig rig = make_rig();
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 0.5);
  const cv::Mat F = (cv::Mat_<double>(3, 3) << 0, 0, 0, 0, 0, -1, 0, 1, 0);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p(0.1, 0.05, 1.1);
    const Vec2 left = rig.project_rectified(kLeft, p) + Vec2(noise(random), noise(random));
    const Vec2 right = rig.project_rectified(kRight, p) + Vec2(noise(random), noise(random));
    cv::Mat l = (cv::Mat_<cv::Vec2d>(1, 1) << cv::Vec2d(left.x(), left.y()));
    cv::Mat r = (cv::Mat_<cv::Vec2d>(1, 1) << cv::Vec2d(right.x(), right.y()));
    cv::Mat best_l, best_r;
    cv::correctMatches(F, l, r, best_l, best_r);
    const auto at = [](const cv::Mat& m) {
      return Vec2(m.at<cv::Vec2d>(0)[0], m.at<cv::Vec2d>(0)[1]);
    };
    const Vec3 expected = rig.triangulate(at(best_l), at(best_r));
    EXPECT_NEAR((rig.triangulate(left, right) - expected).norm(), 0.0, 1e-7);
  }
}

class RigFiles : public ::testing::Test {
 protected:
  void write(const std::string& left, const std::string& right) {
    folder_.write("left.yaml", left);
    folder_.write("right.yaml", right);
  }
  void refuse(const std::string& left, const std::string& right, const std::string& part) {
    write(left, right);
    expect_bad_input([&] { StereoRig::load(folder_.path()); }, part);
  }

  const StereoRig rig_ = make_rig();
  const std::string left_ = rig_.camera(kLeft).to_yaml(), right_ = rig_.camera(kRight).to_yaml();
  TemporaryFolder folder_;
};

TEST_F(RigFiles, SurviveWritingAndReading) {
  write(left_, right_);
  const StereoRig again = StereoRig::load(folder_.path());
  for (const Side side : {kLeft, kRight}) {
    EXPECT_EQ(again.camera(side).P, rig_.camera(side).P);
    EXPECT_EQ(again.camera(side).R, rig_.camera(side).R);
    EXPECT_EQ(again.camera(side).distortion, rig_.camera(side).distortion);
  }
}

TEST_F(RigFiles, OfOtherCalibratorsAreRead) {
  // camera_calibration writes block lists and rational_polynomial; OpenCV an odd header.
  std::string left = replaced(left_, "plumb_bob", "rational_polynomial");
  left = replaced(left, "cols: 5", "cols: 8");
  left = replaced(left, "-0.00040000000000000002, 0]", "-0.0004, 0, 0, 0, 0]");
  write("%YAML:1.0\n---\n" + left, right_);
  EXPECT_NEAR(StereoRig::load(folder_.path()).baseline(), 0.3, 1e-4);
}

TEST_F(RigFiles, ThatAreNoPairAreRefused) {
  refuse(right_, left_, "swapped");
  refuse(left_, left_, "expected the calibration of a pair");
  refuse(left_, replaced(right_, "-454.86", "454.86"), "mirrored");
  refuse(left_, replaced(right_, "-454.86", "-454860."), "in metres");
  refuse(left_, replaced(right_, "image_width: 648", "image_width: 640"), "same size");
}

TEST_F(RigFiles, AreNamedOnlyWhereTheCalibrationIsFromThem) {
  const CameraModel &left = rig_.camera(kLeft), &right = rig_.camera(kRight);
  refuse(left_, left_, ": right.yaml: projection_matrix: baseline");
  expect_bad_input([&] { StereoRig none(left, left); },
                   "right camera: projection_matrix: baseline");
  expect_bad_input([&] { StereoRig none(right, left, " camera_info"); },
                   "left camera_info: projection_matrix: left and right are swapped");
}

TEST_F(RigFiles, WithBrokenValuesAreRefused) {
  refuse(replaced(left_, "image_width: 648", "image_width: wide"), right_,
         "left.yaml:1: image_width: wide: expected an integer from 1 to 100000");
  refuse(replaced(left_, "plumb_bob", "equidistant"), right_,
         "left.yaml:8: distortion_model: equidistant: expected plumb_bob or rational_polynomial");
  refuse(replaced(left_, "camera_matrix", "kamera_matrix"), right_,
         "left.yaml:1: key 'camera_matrix' is missing");
  refuse(left_ + "camera_name: twice\n", right_, "camera_name: appears twice");
  refuse("[1, 2", right_, "left.yaml:1");
  expect_bad_input([] { StereoRig::load("/nowhere"); }, "/nowhere/left.yaml: no such file");
  refuse(replaced(left_, "rows: 3", "rows: 2"), right_,
         "camera_matrix.rows: 2: expected an integer from 3 to 3");
  refuse(replaced(left_, "data: [", "data: [7, "), right_,
         "camera_matrix.data: a list of 10: expected 9 numbers");
}

// A matrix of numbers in another order is a camera, too, but not this one.
TEST_F(RigFiles, WithMatricesInAnotherOrderAreRefused) {
  const auto with_matrix = [&](const std::string& numbers) {
    const auto key = left_.find("camera_matrix"), begin = left_.find('[', key);
    return left_.substr(0, begin) + numbers + left_.substr(left_.find(']', key) + 1);
  };
  const std::string key = "left.yaml:4: camera_matrix: ";
  refuse(with_matrix("[1000, 0, 0, 0, 1000, 0, 324, 244, 1]"), right_,
         key +
             "expected [fx, 0, cx, 0, fy, cy, 0, 0, 1] with fx, fy > 0; this one is written "
             "column by column");
  refuse(with_matrix("[1000, 0, 324, 0, 1000, 244, 0, 1, 1]"), right_, key + "expected [fx");
  refuse(with_matrix("[1000, 324, 0, 0, 1000, 244, 0, 0, 1]"), right_, key + "expected [fx");
  // Its rows and columns interchanged, of a picture of 648 x 488: cy where cx should be.
  refuse(with_matrix("[1000, 0, 244, 0, 1000, 524, 0, 0, 1]"), right_,
         key + "expected a principal point (cx, cy) in the picture of 648 x 488 pixels");
  refuse(with_matrix("[1000, 0, -324, 0, 1000, 244, 0, 0, 1]"), right_, "principal point");
  const auto key_of_p = right_.find("projection_matrix"), begin = right_.find('[', key_of_p);
  refuse(left_,
         right_.substr(0, begin) + "[1000, 0, 0, 0, 1000, 0, 324, 244, 1, -300, 0, 0]" +
             right_.substr(right_.find(']', key_of_p) + 1),
         "right.yaml:17: projection_matrix: expected a rectified camera");
}

TEST_F(RigFiles, MayHoldMoreKeysButNoEndlessOnes) {
  write(left_ + "extra: {x: 1}\n", right_ + "empty:\n");
  EXPECT_NO_THROW(StereoRig::load(folder_.path()));
  refuse(left_ + "extra: &e {x: *e}\n", right_, "nested more than 100 deep");
  refuse(left_, right_ + "extra: &e [*e, *e]\n", "nested more than 100 deep");
}

TEST_F(RigFiles, InOtherUnitsThanMetresAreRefused) {
  // --square 2.5 of a board of 25 mm.
  refuse(left_, replaced(right_, "-454.86", "-45486."),
         "right.yaml: projection_matrix: baseline 30.0");
  refuse(left_, replaced(right_, "-454.86", "-45486."), "in metres (between 0.001 and 5)");
}

TEST_F(RigFiles, WithAMirrorAreRefused) {
  CameraModel mirrored = rig_.camera(kLeft);
  mirrored.R.row(0) *= -1.0;
  refuse(mirrored.to_yaml(), right_, "mirrored");
  mirrored.R *= 1.1;
  refuse(mirrored.to_yaml(), right_, "not orthonormal");
}

}  // namespace
}  // namespace mocap
}  // namespace anthrob
