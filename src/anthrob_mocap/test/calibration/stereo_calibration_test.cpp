// Calibration of rigs and targets: recovery of what was simulated, refusals, and the pictures that
// Debian's opencv-doc ships, where it is installed.
#include "calibration/stereo_calibration.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "calibration/target_calibration.h"
#include "expect_bad_input.h"
#include "source/image_file.h"
#include "support.h"

namespace anthrob {
namespace mocap {
namespace {

using test::expect_bad_input;
using test::make_rig;

const Board kBoard{9, 6, 0.025};

/// A board held all over the view of a rig, corners with noise.
/// @param most_turn about each axis [rad]
std::vector<BoardView> simulate(const StereoRig& rig, int count, double noise,
                                double most_turn = 0.5) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> x(-0.12, 0.4), y(-0.2, 0.2), z(0.7, 1.3),
      turn(-most_turn, most_turn);
  std::normal_distribution<double> pixel(0.0, noise);
  std::vector<BoardView> views;
  while (static_cast<int>(views.size()) < count) {
    const Pose X{exp_rotation({turn(random), turn(random), turn(random)}),
                 {x(random), y(random), z(random)}};
    BoardView view;
    view.name = std::to_string(views.size());
    bool inside = true;
    for (const Vec3& p : kBoard.points()) {
      for (const Side side : {kLeft, kRight}) {
        const Vec2 c = rig.project(side, X * (p - Vec3(0.1, 0.0625, 0.0)));
        inside &= c.x() > 5 && c.y() > 5 && c.x() < rig.width() - 5 && c.y() < rig.height() - 5;
        view.corners[side].push_back(c + Vec2(pixel(random), pixel(random)));
      }
    }
    if (inside) views.push_back(view);
  }
  return views;
}

StereoCalibration calibrate(const std::vector<BoardView>& views) {
  return calibrate_stereo(views, kBoard, 648, 488, {});
}

TEST(StereoCalibration, RecoversARig) {
  const StereoRig rig = make_rig();
  const StereoCalibration result = calibrate(simulate(rig, 20, 0.05));
  EXPECT_NEAR(result.rig.baseline(), rig.baseline(), 3e-4);
  EXPECT_NEAR(result.rig.camera(kLeft).fx, 1071.0, 2.0);
  EXPECT_NEAR(result.rig.camera(kRight).cy, 241.0, 2.0);
  EXPECT_NEAR(result.stereo_rms, 0.07, 0.02);  // 0.05 in each of two axes
  EXPECT_LT(result.epipolar_rms, 0.1);
  EXPECT_NE(result.report().find("baseline"), std::string::npos);
}

TEST(StereoCalibration, LeavesOutAViewThatDoesNotFit) {
  std::vector<BoardView> views = simulate(make_rig(), 20, 0.05);
  for (Vec2& c : views[7].corners[kRight]) c.y() += 1.5;  // the board moved between the pictures
  const StereoCalibration result = calibrate(views);
  EXPECT_EQ(result.dropped, std::vector<std::string>{"7"});
  EXPECT_EQ(result.views, 19);
}

TEST(StereoCalibration, RefusesWhatCannotBeTrusted) {
  const std::vector<BoardView> good = simulate(make_rig(), 12, 0.05);
  std::vector<BoardView> views = good;
  for (BoardView& view : views) std::swap(view.corners[kLeft], view.corners[kRight]);
  expect_bad_input([&] { calibrate(views); }, "swapped or the images mirrored");
  expect_bad_input([&] { calibrate(views); }, "never flip pictures");

  views = good;  // both cameras behind a mirror
  for (BoardView& view : views) {
    for (const Side side : {kLeft, kRight}) {
      for (Vec2& c : view.corners[side]) c.x() = 647.0 - c.x();
    }
  }
  expect_bad_input([&] { calibrate(views); }, "swapped or the images mirrored");

  views = good;  // one of them
  for (BoardView& view : views) {
    for (Vec2& c : view.corners[kRight]) c.x() = 647.0 - c.x();
  }
  expect_bad_input([&] { calibrate(views); }, "calibration: ");

  views.assign(good.begin(), good.begin() + 5);
  expect_bad_input([&] { calibrate(views); }, "5 usable views: expected at least 8");

  std::mt19937_64 random(1);
  std::normal_distribution<double> pixel(0.0, 2.0);
  views = good;
  for (BoardView& view : views) {
    for (Vec2& c : view.corners[kLeft]) c += Vec2(pixel(random), pixel(random));
  }
  expect_bad_input([&] { calibrate(views); }, "reprojection error");

  CalibrationLimits limits;
  limits.least_coverage = 0.999;
  expect_bad_input([&] { calibrate_stereo(good, kBoard, 648, 488, limits); }, "covers");
}

TEST(StereoCalibration, RefusesBoardsThatAreParallelToThePicture) {
  // Their residuals are as good as any, but the focal length is anything.
  expect_bad_input([] { calibrate(simulate(make_rig(), 16, 0.1, 0.02)); },
                   "degrees rms: expected at least 10; tilt it by 20 to 40 degrees");
  const StereoCalibration tilted = calibrate(simulate(make_rig(), 16, 0.1, 0.35));
  EXPECT_NEAR(tilted.tilt, 0.28, 0.05);
  EXPECT_NEAR(tilted.rig.camera(kLeft).fx, 1071.0, 5.0);
}

TEST(Board, IsChecked) {
  EXPECT_EQ(Board::parse("8x5", 0.03).points().size(), 40u);
  expect_bad_input([] { Board::parse("9by6", 0.03); }, "--board 9by6");
  expect_bad_input([] { Board::parse("6x6", 0.03); }, "square board");
  expect_bad_input([] { Board::parse("9x6", -1.0); }, "--square");
  expect_bad_input([] { Board::parse("9x6", 2.5); }, "--square 2.5");  // [cm]
  expect_bad_input([] { Board::parse("9x6", 25.0); }, "in metres, above 0 and below 1");
}

/// A picture of squares of so many pixels, seen straight on but drawn together as by a slant.
Image draw_board(double width, double height) {
  constexpr int kFine = 8;  // samples by pixel and axis
  const Vec2 corner(100.3, 100.6);
  Image image;
  image.resize(648, 488);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      int light = 0;
      for (int s = 0; s < kFine * kFine; ++s) {
        const double u = x + (s % kFine + 0.5) / kFine - 0.5 - corner.x();
        const double v = y + (s / kFine + 0.5) / kFine - 0.5 - corner.y();
        const int column = static_cast<int>(std::floor(u / width));
        const int row = static_cast<int>(std::floor(v / height));
        const bool board = column >= -1 && column <= 8 && row >= -1 && row <= 5;
        light += board && (column + row) % 2 == 0 ? 0 : 200;
      }
      image.row(y)[x] = static_cast<std::uint8_t>(20 + light / (kFine * kFine));
    }
  }
  return image;
}

TEST(Checkerboard, IsFoundWithSquaresThatAreNarrowInEitherDirection) {
  for (const Vec2& square : {Vec2(30, 30), Vec2(40, 11), Vec2(11, 40)}) {
    auto corners = find_corners(draw_board(square.x(), square.y()), kBoard);
    ASSERT_TRUE(corners.has_value()) << square.transpose();
    if (corners->front().y() > corners->back().y()) std::reverse(corners->begin(), corners->end());
    double worst = 0.0;
    for (int i = 0; i < 54; ++i) {
      const Vec2 truth(100.3 + i % 9 * square.x(), 100.6 + i / 9 * square.y());
      worst = std::max(worst, ((*corners)[static_cast<std::size_t>(i)] - truth).norm());
    }
    EXPECT_LT(worst, 0.1) << square.transpose();
  }
}

TEST(StereoCalibration, OfRealPictures) {
  const std::string folder = "/usr/share/doc/opencv-doc/examples/data/";
  if (!std::filesystem::exists(folder + "left01.jpg")) {
    GTEST_SKIP() << "Debian's opencv-doc is not installed: no pictures of real checkerboards";
  }
  std::vector<BoardView> views;
  for (const char* number :
       {"01", "02", "03", "04", "05", "06", "07", "08", "09", "11", "12", "13", "14"}) {
    BoardView view;
    view.name = number;
    for (const Side side : {kLeft, kRight}) {
      const auto corners =
          find_corners(read_any_image(folder + name(side) + number + ".jpg"), kBoard);
      ASSERT_TRUE(corners.has_value()) << name(side) << number;
      view.corners[side] = *corners;
    }
    same_direction(view.corners[kLeft], view.corners[kRight]);
    views.push_back(view);
  }
  const StereoCalibration result = calibrate_stereo(views, kBoard, 640, 480, {});
  EXPECT_EQ(result.views, 13);
  EXPECT_LE(result.stereo_rms, 0.64);
  EXPECT_NEAR(result.rig.baseline(), 0.0836, 0.0006);
}

TEST(TargetCalibration, RecoversATargetMeasuredByHand) {
  const StereoRig rig = make_rig();
  const TargetSet truth = test::make_targets();
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> by_hand(-0.004, 0.004);
  MarkerTarget guess = truth.targets[1];
  for (Vec3& m : guess.markers) m += Vec3(by_hand(random), by_hand(random), by_hand(random));
  const auto record = [&](double loose) {
    test::Session session(rig, truth);
    std::vector<std::vector<MarkerPoint>> frames;
    const test::Motion motion = test::swing(0.6, 1.0);
    for (int i = 0; i < 80; ++i) {
      TargetSet shaken = truth;
      shaken.targets[1].markers[2].z() += i % 2 ? loose : -loose;
      frames.push_back(session.track(i / 10.0, {test::scene_of(shaken, motion(i / 10.0))}).points);
    }
    return frames;
  };
  const TargetCalibration result = calibrate_target(guess, record(0.0));
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_LT(result.rms[i], 3e-4) << i;
    for (std::size_t j = 0; j < i; ++j) {
      const auto edge = [&](const MarkerTarget& t) { return (t.markers[i] - t.markers[j]).norm(); };
      EXPECT_NEAR(edge(result.target), edge(truth.targets[1]), 1e-4) << i << j;
    }
    // It keeps the axes of the guess, as well as those are known.
    EXPECT_LT((result.target.markers[i] - truth.targets[1].markers[i]).norm(), 0.006);
  }
  MarkerTarget wrong = guess;
  wrong.markers[2].x() += 0.05;
  expect_bad_input([&] { calibrate_target(wrong, record(0.0)); }, "marker 2 was seen in 0 frames");
  expect_bad_input([&] { calibrate_target(guess, record(0.0025)); }, "marker 2 scatters by ");
}

/// A target whose mirror image lies within the tolerance of a guess.
MarkerTarget thin_target() {
  return {"thin",
          {{0.0, 0.0, 0.0},
           {0.15, 0.0, 0.0},
           {0.0, 0.095, 0.009},
           {0.1, 0.12, -0.009},
           {0.045, 0.04, 0.015}}};
}

/// Poses in view of the rig of the tests, with the markers in the middle of the picture.
std::vector<Pose> poses_in_view(const MarkerTarget& target) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> turn(-0.4, 0.4);
  std::vector<Pose> poses;
  for (int i = 0; i < 30; ++i) {
    Pose X{exp_rotation({turn(random), turn(random), turn(random)}), Vec3(0.15, 0.0, 1.1)};
    X.p -= X.R * target.centre();
    poses.push_back(X);
  }
  return poses;
}

using Frames = std::vector<std::vector<MarkerPoint>>;

/// What `see` makes of the markers of a target in 30 poses.
template <typename See>
Frames frames_of(const MarkerTarget& target, const See& see) {
  Frames frames;
  for (const Pose& X : poses_in_view(target)) {
    frames.emplace_back();
    for (std::size_t i = 0; i < target.markers.size(); ++i) {
      MarkerPoint point;
      point.p = see(X * target.markers[i]);
      point.blob[kLeft] = point.blob[kRight] = static_cast<int>(i);
      frames.back().push_back(point);
    }
  }
  return frames;
}

TEST(TargetCalibration, RefusesAMirrorImage) {
  const MarkerTarget truth = thin_target();
  const Frames seen = frames_of(truth, [](const Vec3& p) { return p; });
  EXPECT_NO_THROW(calibrate_target(truth, seen));
  const Frames mirrored =
      frames_of(truth, [](const Vec3& p) { return Vec3(p.x(), -p.y(), p.z()); });
  const std::string why = "target thin: the markers come out mirrored: is an image flipped?";
  expect_bad_input([&] { calibrate_target(truth, mirrored); }, why);
  MarkerTarget by_hand = truth;  // off by some millimetres
  by_hand.markers[1] += Vec3(0.004, -0.003, 0.002), by_hand.markers[3].z() += 0.004;
  EXPECT_NO_THROW(calibrate_target(by_hand, seen));
  expect_bad_input([&] { calibrate_target(by_hand, mirrored); }, why);
}

TEST(TargetCalibration, NoticesPicturesThatWereUpsideDownAllTheTime) {
  // Nothing is wrong with the calibration of the cameras, but that it is mirrored.
  const StereoRig rig = make_rig();
  const auto flip = [](Vec2 c) { return Vec2(c.x(), 487.0 - c.y()); };
  std::vector<BoardView> views = simulate(rig, 20, 0.05);
  for (BoardView& view : views) {
    for (const Side side : {kLeft, kRight}) {
      for (Vec2& c : view.corners[side]) c = flip(c);
    }
  }
  const StereoRig believed = calibrate(views).rig;
  const MarkerTarget truth = thin_target();
  const Frames frames = frames_of(truth, [&](const Vec3& p) {
    return believed.triangulate(believed.rectify(kLeft, flip(rig.project(kLeft, p))),
                                believed.rectify(kRight, flip(rig.project(kRight, p))));
  });
  expect_bad_input([&] { calibrate_target(truth, frames); }, "is an image flipped?");
}

TEST(TargetCalibration, RefusesATargetUnlikeTheGuess) {
  // A marker of the guess stands 35 mm out of the plane in which it is.
  const MarkerTarget guess{
      "flat", {{0, 0, 0}, {0.15, 0, 0}, {0, 0.095, 0}, {0.1, 0.12, 0}, {0.045, 0.04, 0.035}}};
  MarkerTarget truth = guess;
  truth.markers[4].z() = 0.0;
  const Frames frames = frames_of(truth, [](const Vec3& p) { return p; });
  EXPECT_NO_THROW(calibrate_target(truth, frames));
  expect_bad_input([&] { calibrate_target(guess, frames); }, "target flat: marker 4 comes out 27.");
}

}  // namespace
}  // namespace mocap
}  // namespace anthrob
