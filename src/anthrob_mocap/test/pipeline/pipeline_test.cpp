// Pipeline: order and failures in both modes, equal results, no growth; contradictions.
#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <random>
#include <sstream>
#include <thread>

#include "expect_bad_input.h"
#include "output/pose_table.h"
#include "pipeline/health.h"
#include "pipeline/tracker_file.h"
#include "support.h"
#include "temporary_folder.h"

namespace anthrob {
namespace mocap {
namespace {

using test::make_rig;
using test::make_targets;
using test::Session;

struct Number final : Packet {
  int value = 0;
};

class EitherMode : public ::testing::TestWithParam<PipelineMode> {};
INSTANTIATE_TEST_SUITE_P(Modes, EitherMode,
                         ::testing::Values(PipelineMode::kSequential, PipelineMode::kThreaded));

// A new process, because TBB counts the processors once.
TEST(PipelineDeathTest, ThreadedRunsOnASingleProcessorToo) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto run = [] {
    alarm(20);  // it once waited for ever
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(static_cast<unsigned>(sched_getcpu()), &one);
    if (sched_setaffinity(0, sizeof(one), &one) != 0) std::exit(2);
    int done = 0;
    Pipeline pipeline({{"stage", {[](Packet&) {}}}}, PipelineMode::kThreaded, 2,
                      [&](PacketPtr) { ++done; });
    for (int i = 0; i < 10; ++i) pipeline.push(std::make_unique<Number>());
    pipeline.drain();
    std::exit(done == 10 ? 0 : 1);
  };
  EXPECT_EXIT(run(), testing::ExitedWithCode(0), "");
}

TEST_P(EitherMode, KeepsTheOrderInEveryStage) {
  std::vector<std::vector<int>> seen(3);
  std::vector<Stage> stages;
  for (std::size_t i = 0; i < 3; ++i) {
    stages.push_back(
        {"stage",
         {[&seen, i](Packet& packet) { seen[i].push_back(static_cast<Number&>(packet).value); },
          [](Packet&) { std::this_thread::yield(); }}});
  }
  std::vector<int> out;
  Pipeline pipeline(stages, GetParam(), 4, [&](PacketPtr packet) {
    out.push_back(static_cast<Number&>(*packet).value);
    EXPECT_EQ(packet->stage_seconds.size(), 3u);
  });
  std::vector<int> in;
  for (int i = 0; i < 500; ++i) {
    auto packet = std::make_unique<Number>();
    packet->value = i;
    in.push_back(i);
    pipeline.push(std::move(packet));
  }
  pipeline.drain();
  EXPECT_EQ(out, in);
  for (const auto& stage : seen) EXPECT_EQ(stage, in);
}

TEST_P(EitherMode, HandsOnWhatAStageThrows) {
  Pipeline pipeline({{"fails", {[](Packet& packet) {
                        if (static_cast<Number&>(packet).value == 3) throw BadInput("three");
                      }}}},
                    GetParam(), 2, [](PacketPtr) {});
  EXPECT_THROW(
      {
        for (int i = 0; i < 10; ++i) {
          auto packet = std::make_unique<Number>();
          packet->value = i;
          pipeline.push(std::move(packet));
        }
        pipeline.drain();
      },
      BadInput);
}

TEST_P(EitherMode, HandsOnWhatTheSinkThrowsWithoutBeingDrained) {
  Pipeline pipeline({{"works", {[](Packet&) {}}}}, GetParam(), 2,
                    [](PacketPtr) { throw std::runtime_error("sink"); });
  const auto push_for_long = [&] {
    for (int i = 0; i < 1000; ++i) pipeline.push(std::make_unique<Number>());
  };
  EXPECT_THROW(push_for_long(), std::runtime_error);
}

TEST(Pipeline, RefusesNonsense) {
  EXPECT_THROW(Pipeline({}, PipelineMode::kSequential, 1, [](PacketPtr) {}), std::invalid_argument);
  EXPECT_THROW(Pipeline({{"s", {}}}, PipelineMode::kThreaded, 0, [](PacketPtr) {}),
               std::invalid_argument);
  test::expect_bad_input([] { pipeline_mode("parallel"); }, "expected sequential or threaded");
}

/// Rendered pairs, made once.
class Recording {
 public:
  explicit Recording(int count) {
    const TargetSet set = make_targets();
    Renderer renderer(rig_, RenderOptions());
    std::mt19937_64 random(3);
    const test::Motion motion = test::swing(0.5, 2.0);
    for (int i = 0; i < count; ++i) {
      Scene scene = test::scene_of(set, motion(i / 60.0));
      test::add_distractors(scene, 10, random);
      for (const Side side : {kLeft, kRight}) {
        images_[side].emplace_back();
        renderer.render(side, {scene}, static_cast<std::uint64_t>(i), images_[side].back());
      }
    }
  }
  std::unique_ptr<StereoFrame> frame(int i) const {
    auto frame = std::make_unique<StereoFrame>();
    frame->index = static_cast<std::uint64_t>(i);
    frame->t = i / 60.0;
    for (const Side side : {kLeft, kRight}) {
      frame->image[side] = images_[side][static_cast<std::size_t>(i) % images_[side].size()].view();
    }
    return frame;
  }
  const StereoRig& rig() const { return rig_; }

 private:
  StereoRig rig_ = make_rig();
  std::vector<Image> images_[2];
};

TEST(Tracking, GivesTheSameBitsInBothModes) {
  const Recording recording(60);
  std::vector<std::string> table;
  std::vector<std::vector<double>> numbers;
  for (const PipelineMode mode : {PipelineMode::kSequential, PipelineMode::kThreaded}) {
    std::ostringstream out;
    PoseTable poses(out, make_targets());
    std::vector<double> bits;
    Pipeline pipeline(
        tracking_stages(recording.rig(), make_targets(), {}), mode, 4, [&](PacketPtr packet) {
          const auto& frame = static_cast<StereoFrame&>(*packet);
          poses.add(frame);
          for (const TargetPose& pose : frame.targets) {
            bits.insert(bits.end(), pose.X.R.data(), pose.X.R.data() + 9);
            bits.insert(bits.end(), pose.covariance.data(), pose.covariance.data() + 36);
          }
          for (const JointEstimate& joint : frame.joints) {
            bits.insert(bits.end(), joint.velocity.data(), joint.velocity.data() + 3);
          }
        });
    for (int i = 0; i < 60; ++i) pipeline.push(recording.frame(i));
    pipeline.drain();
    table.push_back(out.str());
    numbers.push_back(bits);
  }
  EXPECT_EQ(table[0], table[1]);
  ASSERT_EQ(numbers[0].size(), numbers[1].size());
  EXPECT_EQ(std::memcmp(numbers[0].data(), numbers[1].data(), 8 * numbers[0].size()), 0);
  EXPECT_NE(table[0].find(",1,"), std::string::npos);
}

TEST_P(EitherMode, DoesNotGrow) {
  // ANTHROB_MOCAP_PAIRS=5184000 is a day at 60 Hz.
  const char* wanted = std::getenv("ANTHROB_MOCAP_PAIRS");
  const int count = wanted ? std::atoi(wanted) : 10000;
  const Recording recording(60);
  int poses = 0;
  Pipeline pipeline(tracking_stages(recording.rig(), make_targets(), {}), GetParam(), 4,
                    [&](PacketPtr packet) {
                      poses += static_cast<StereoFrame&>(*packet).targets[0].valid ? 1 : 0;
                    });
  const int warm = count / 5;
  for (int i = 0; i < warm; ++i) pipeline.push(recording.frame(i));
  pipeline.drain();
  const double before = test::resident_bytes();
  for (int i = warm; i < count; ++i) pipeline.push(recording.frame(i));
  pipeline.drain();
  EXPECT_LT(test::resident_bytes() - before, 2e6);
  EXPECT_GT(poses, 9 * count / 10);
  RecordProperty("growth_kB", static_cast<int>(1e-3 * (test::resident_bytes() - before)));
}

/// Tracks 20 pairs after something has been done to them.
Health health_of(const StereoRig& rendered, const StereoRig& believed, bool swap, double late,
                 double believed_diameter = 0.016, double rate = 2.0) {
  Renderer renderer(rendered, RenderOptions());
  const TargetSet set = make_targets();
  const test::Motion motion = test::swing(0.5, rate);
  TargetSet believed_set = set;
  believed_set.marker_diameter = believed_diameter;
  MatchingOptions matching;
  matching.marker_diameter = believed_diameter;
  Health health(believed, matching);
  Pipeline pipeline(tracking_stages(believed, believed_set, {}), PipelineMode::kSequential, 1,
                    [&](PacketPtr packet) { health.add(static_cast<StereoFrame&>(*packet)); });
  for (int i = 0; i < 20; ++i) {
    auto frame = std::make_unique<StereoFrame>();
    frame->t = i / 60.0;
    Image images[2];
    for (const Side side : {kLeft, kRight}) {
      const double t = frame->t + (side == kRight ? late : 0.0);
      renderer.render(side, {test::scene_of(set, motion(t))}, 1, images[side]);
      frame->image[swap ? 1 - side : side] = images[side].view();
    }
    pipeline.push(std::move(frame));
  }
  return health;
}

TEST(Health, KnowsSwappedImagesAndForeignCalibrations) {
  const StereoRig rig = make_rig();
  EXPECT_EQ(health_of(rig, rig, false, 0.0).advice(), std::nullopt);
  EXPECT_GT(health_of(rig, rig, false, 0.0).poses(), 30);
  const Health swapped = health_of(rig, rig, true, 0.0);
  EXPECT_EQ(swapped.poses(), 0);
  EXPECT_NE(swapped.contradiction().value().find("swapped"), std::string::npos);
  CameraModel tilted = rig.camera(kRight);
  tilted.R = exp_rotation({0.03, 0.0, 0.0}) * tilted.R;
  const Health foreign = health_of(rig, StereoRig(rig.camera(kLeft), tilted), false, 0.0);
  EXPECT_EQ(foreign.poses(), 0);
  EXPECT_NE(foreign.contradiction().value().find("calibration"), std::string::npos);
  // Lamps: on common rows, but of no marker's size.
  const Health lamps = health_of(rig, rig, false, 0.0, 0.002);
  EXPECT_EQ(lamps.poses(), 0);
  EXPECT_EQ(lamps.contradiction(), std::nullopt);
  EXPECT_NE(lamps.advice().value().find("form no target"), std::string::npos)
      << lamps.advice().value();
}

TEST(Health, SeesARigThatHasMoved) {
  const StereoRig rig = make_rig();
  CameraModel tilted = rig.camera(kRight);
  tilted.R = exp_rotation({0.0004, 0.0, 0.0}) * tilted.R;
  const Health moved = health_of(rig, StereoRig(rig.camera(kLeft), tilted), false, 0.0);
  EXPECT_GT(moved.poses(), 0);
  EXPECT_GT(std::abs(moved.row_error()), 0.3);
  EXPECT_NE(moved.bend().value().find("rows of left and right differ by "), std::string::npos);
  const Health good = health_of(rig, rig, false, 0.0);
  EXPECT_EQ(good.bend(), std::nullopt);
  for (const std::size_t target : {0, 1}) {
    EXPECT_GT(good.residual(target), 0.0);
    EXPECT_LT(good.residual(target), 0.05);
  }
}

TEST(Health, SeesARigThatHasTurnedAlongItsRows) {
  // Depths are wrong then, and angles by almost a degree, but rows still agree.
  const StereoRig rig = make_rig();
  CameraModel turned = rig.camera(kRight);
  turned.R = exp_rotation({0.0, 0.003, 0.0}) * turned.R;
  const Health moved = health_of(rig, StereoRig(rig.camera(kLeft), turned), false, 0.0);
  EXPECT_GT(moved.poses(), 30);
  EXPECT_LT(std::abs(moved.row_error()), 0.1);
  EXPECT_NE(moved.bend().value().find("pixels rms off their target: the rig has been bent"),
            std::string::npos)
      << moved.bend().value();
}

/// Tracks 30 pairs of a rig whose right camera has been turned since it was calibrated.
Health health_of_turned(const Vec3& turn, const RenderOptions& render, double brightness) {
  const StereoRig rig = make_rig();
  CameraModel turned = rig.camera(kRight);
  turned.R = exp_rotation(turn) * turned.R;
  const StereoRig believed(rig.camera(kLeft), turned);
  const TargetSet set = make_targets();
  Renderer renderer(rig, render);
  Health health(believed, matching_of(set, {}));
  Pipeline pipeline(tracking_stages(believed, set, {}), PipelineMode::kSequential, 1,
                    [&](PacketPtr packet) { health.add(static_cast<StereoFrame&>(*packet)); });
  for (int i = 0; i < 30; ++i) {
    auto frame = std::make_unique<StereoFrame>();
    frame->t = i / 60.0;
    Scene scene = test::scene_of(set, test::swing(0.5, 2.0)(frame->t));
    for (Sphere& sphere : scene.spheres) sphere.brightness = brightness;
    Image images[2];
    for (const Side side : {kLeft, kRight}) {
      renderer.render(side, {scene}, static_cast<std::uint64_t>(i), images[side]);
      frame->image[side] = images[side].view();
    }
    pipeline.push(std::move(frame));
  }
  EXPECT_GT(health.poses(), 50);
  return health;
}

TEST(Health, SeesATenthOfADegreeAndIsQuietWithoutIt) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    RenderOptions render;
    render.seed = seed;
    const auto said = [&](const Vec3& degrees, double brightness = 180.0) {
      return health_of_turned(degrees * test::kDegree, render, brightness).bend().value_or("quiet");
    };
    for (const double brightness : {60.0, 180.0, 250.0}) {
      EXPECT_EQ(said(Vec3::Zero(), brightness), "quiet") << seed << " " << brightness;
    }
    for (const double degrees : {-0.1, -0.05, 0.05, 0.1}) {
      EXPECT_EQ(said({0.0, degrees, 0.0}).find("markers are "), 0u) << seed << " " << degrees;
      EXPECT_EQ(said({0.0, 0.0, degrees}).find("rows of left"), 0u) << seed << " " << degrees;
      EXPECT_EQ(said({0.2 * degrees, 0.0, 0.0}).find("rows of left"), 0u) << seed << " " << degrees;
    }
  }
}

TEST(Health, TakesNoNoiseForABend) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    RenderOptions noisy;
    noisy.seed = seed;
    noisy.read_noise = 6.5;
    const Health sound = health_of_turned(Vec3::Zero(), noisy, 60.0);
    EXPECT_GT(sound.residual(1), 0.05);
    EXPECT_NEAR(sound.noise(), sound.residual(1), 0.3 * sound.noise());
    EXPECT_EQ(sound.bend(), std::nullopt) << *sound.bend();
    const Health bent = health_of_turned({0.0, 0.1 * test::kDegree, 0.0}, noisy, 60.0);
    EXPECT_NE(bent.bend(), std::nullopt);
  }
}

TEST(Health, SeesPairsThatAreNotSynchronised) {
  const StereoRig rig = make_rig();
  const Health late = health_of(rig, rig, false, 1.0 / 60.0, 0.016, 0.7);
  EXPECT_GT(late.poses(), 20);
  EXPECT_NE(late.bend().value().find("not synchronised"), std::string::npos) << late.bend().value();
}

/// What is said of a rig whose cameras look at each other by 8 degrees, without drawing the
/// pictures.
/// @param turn of the right camera, unknown to the calibration   @param specks beside the markers
std::optional<std::string> contradiction_of(const Vec3& turn, int specks, bool swap) {
  const StereoRig rig = make_rig(8.0 * test::kDegree);
  CameraModel turned = rig.camera(kRight);
  turned.R = exp_rotation(turn) * turned.R;
  const StereoRig believed(rig.camera(kLeft), turned);
  const TargetSet set = make_targets();
  EpipolarMatcher matcher(believed, matching_of(set, {}));
  Health health(believed, matching_of(set, {}));
  for (int i = 0; i < 10; ++i) {
    Scene scene = test::scene_of(set, test::swing(0.5, 2.0)(i / 60.0));
    std::mt19937_64 random(5);
    test::add_distractors(scene, specks, random);
    StereoFrame frame;
    for (const Side side : {kLeft, kRight}) {
      const Side seen = swap ? (side == kLeft ? kRight : kLeft) : side;
      for (const Sphere& sphere : scene.spheres) {
        Blob blob;
        blob.centre = rig.project(seen, sphere.p);
        blob.area = M_PI * std::pow(1070.0 * sphere.radius / sphere.p.z(), 2);
        frame.blobs[side].push_back(blob);
        frame.rectified[side].push_back(believed.rectify(side, blob.centre));
      }
    }
    matcher.match(frame.blobs, frame.rectified, frame.matches);
    health.add(frame);
  }
  return health.contradiction();
}

TEST(Health, DoesNotTakeAPitchedCameraForASwappedOne) {
  for (const int specks : {0, 10, 30}) {
    EXPECT_EQ(contradiction_of(Vec3::Zero(), specks, true), "left and right images are swapped");
    for (int tenths = -80; tenths <= 80; ++tenths) {
      const Vec3 pitch(0.1 * tenths * test::kDegree, 0.0, 0.0);
      EXPECT_NE(contradiction_of(pitch, specks, false).value_or("none"),
                "left and right images are swapped")
          << specks << " specks, pitched by " << 0.1 * tenths << " degrees";
    }
  }
}

/// Dark, with squares of 3 pixels all over.
Image specks(int count, std::mt19937_64& random) {
  Image image;
  image.resize(648, 488);
  std::fill(image.pixels.begin(), image.pixels.end(), static_cast<std::uint8_t>(12));
  std::uniform_int_distribution<int> x(2, 645), y(2, 485);
  for (int i = 0; i < count; ++i) {
    const int column = x(random), row = y(random);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) image.row(row + dy)[column + dx] = 200;
    }
  }
  return image;
}

TEST(Health, FindsNothingInSpecksAndSaysSo) {
  const StereoRig rig = make_rig();
  TargetSet set = make_targets();
  // Of three markers: by chance specks form three markers often, four seldom.
  for (MarkerTarget& target : set.targets) target.markers.resize(3);
  Health health(rig, matching_of(set, {}));
  Pipeline pipeline(tracking_stages(rig, set, {}), PipelineMode::kSequential, 1,
                    [&](PacketPtr packet) { health.add(static_cast<StereoFrame&>(*packet)); });
  std::mt19937_64 random(7);
  for (int i = 0; i < 20; ++i) {
    const Image images[2] = {specks(2500, random), specks(2500, random)};
    auto frame = std::make_unique<StereoFrame>();
    frame->t = i / 60.0;
    for (const Side side : {kLeft, kRight}) frame->image[side] = images[side].view();
    pipeline.push(std::move(frame));
  }
  EXPECT_EQ(health.poses(), 0);
  EXPECT_EQ(health.cut(), 20);
  EXPECT_NE(health.crowd().value().find("20 of 20 pairs show more points than most_points"),
            std::string::npos)
      << health.crowd().value();
  EXPECT_EQ(health.advice(), health.crowd());  // above all not that the images are swapped
}

TEST(Health, PicturesThatWereCutDoNotHideSwappedOnes) {
  const StereoRig rig = make_rig();
  Health health = health_of(rig, rig, true, 0.0);
  StereoFrame full;
  full.cut = true;
  full.matches.resize(400);
  for (int i = 0; i < 5; ++i) health.add(full);
  EXPECT_NE(health.contradiction().value().find("swapped"), std::string::npos);
}

/// @param zoom times that of the plain rig   @param tilt of the right camera [rad]
std::optional<std::string> judged(double zoom, double tilt) {
  const StereoRig rig = make_rig();
  CameraModel cameras[2] = {rig.camera(kLeft), rig.camera(kRight)};
  for (CameraModel& camera : cameras) camera.P.topRows(2) *= zoom;
  const StereoRig believed(cameras[0], cameras[1]);
  EXPECT_NEAR(believed.zoom(), zoom * rig.zoom(), 1e-9);
  const Pose X = test::rest_poses()[0];
  const MarkerTarget target = make_targets().targets[0];
  std::vector<MarkerPoint> points;
  PointPairs pairs;
  Labelling seen;
  for (const Vec3& marker : target.markers) {
    const Vec3 p = X * marker, tilted = exp_rotation({tilt, 0.0, 0.0}) * p;
    MarkerPoint point;
    point.image[kLeft] = believed.rectify(kLeft, rig.project(kLeft, p));
    point.image[kRight] = believed.rectify(kRight, rig.project(kRight, tilted));
    point.p = believed.triangulate(point.image[kLeft], point.image[kRight]);
    seen.point.push_back(static_cast<int>(points.size()));
    pairs.add(marker, point.p);
    points.push_back(point);
  }
  seen.count = static_cast<int>(points.size());
  seen.fit = fit_rigid(pairs);
  StereoFrame frame;
  frame.targets = {PoseEstimator(believed, {target}, {}).estimate(0, seen, points)};
  Health health(believed, {});
  for (int i = 0; i < 5; ++i) health.add(frame);
  return health.bend();
}

TEST(Health, JudgesABentRigAlikeAtAnyZoom) {
  for (const double zoom : {0.5, 1.0, 2.0}) {
    EXPECT_EQ(judged(zoom, 3e-5), std::nullopt) << zoom;
    EXPECT_NE(judged(zoom, 1e-4), std::nullopt) << zoom;
  }
}

TEST(Health, KnowsWhatWasNeverSeen) {
  Health health(make_rig(), MatchingOptions());
  EXPECT_TRUE(health.unseen_targets().empty());
  EXPECT_TRUE(health.unseen_joints().empty());
  StereoFrame frame;
  frame.targets.resize(2);
  frame.joints.resize(1);
  for (const int k : {0, 1}) {  // one after the other
    frame.targets[k].valid = true;
    frame.targets[1 - k].valid = false;
    health.add(frame);
    EXPECT_EQ(health.unseen_targets(),
              k == 0 ? std::vector<std::size_t>{1} : std::vector<std::size_t>{});
    EXPECT_EQ(health.unseen_joints(), std::vector<std::size_t>{0});
  }
  frame.joints[0].valid = true;
  health.add(frame);
  EXPECT_TRUE(health.unseen_joints().empty());
}

TEST(Health, ASinglePoseBendsNoRig) {
  Health health(make_rig(), MatchingOptions());
  StereoFrame frame;
  frame.targets.resize(1);
  frame.targets[0].valid = true;
  frame.targets[0].row_error = -0.35;
  for (int poses = 1; poses <= 5; ++poses) {
    health.add(frame);
    EXPECT_EQ(health.uneven_rows().has_value(), poses >= 5) << poses;
  }
  EXPECT_NE(health.uneven_rows().value().find("differ by -0.350 pixels: recalibrate"),
            std::string::npos)
      << health.uneven_rows().value();
}

TEST(Health, KnowsJointsWhosePicturesAreTooRare) {
  Health health(make_rig(), MatchingOptions());
  JointEstimator estimator(make_targets().joints[0]);
  TargetPose seen;
  seen.valid = true;
  double t = 0.0;
  const auto see = [&](double after, bool hidden = false) {
    StereoFrame frame;
    frame.joints = {estimator.estimate(t += after, seen, hidden ? TargetPose() : seen)};
    health.add(frame);
    health.clear();  // as after every report
    return health.joints_without_velocity();
  };
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(see(0.05).empty()) << i;
  EXPECT_TRUE(see(1.0).empty());  // one gap
  EXPECT_TRUE(see(0.05).empty());
  EXPECT_TRUE(see(0.2).empty());
  EXPECT_TRUE(see(0.2, true).empty());
  EXPECT_TRUE(see(0.2).empty());
  for (int i = 0; i < 3; ++i) EXPECT_EQ(see(0.2), std::vector<std::size_t>{0}) << i;
  EXPECT_TRUE(see(0.05).empty());
  for (int i = 0; i < 3; ++i) see(0.0);  // stamps that stand still
  EXPECT_EQ(health.joints_without_velocity(), std::vector<std::size_t>{0});
}

TEST(TrackerFile, IsStrict) {
  const test::TemporaryFolder folder;
  folder.write("t.yaml", "segmentation: {threshold: 70}\nlabelling: {edge_tolerance: 0.002}\n");
  const TrackerOptions options = load_tracker_options(folder.path("t.yaml"));
  EXPECT_EQ(options.segmentation.threshold, 70);
  EXPECT_EQ(TrackerOptions().segmentation.threshold, std::nullopt);
  EXPECT_EQ(options.labelling.edge_tolerance, 0.002);
  folder.write("t.yaml", "segmentation: {treshold: 70}\n");
  test::expect_bad_input([&] { load_tracker_options(folder.path("t.yaml")); },
                         "t.yaml:1: segmentation.treshold: unknown key");
  folder.write("t.yaml", "segmentation: {threshold: 300}\n");
  test::expect_bad_input([&] { load_tracker_options(folder.path("t.yaml")); },
                         "segmentation.threshold: 300: expected an integer from 1 to 254");
}

TEST(TrackerFile, RefusesWhatIsNoSectionAndBoundsThatAreSwapped) {
  const test::TemporaryFolder folder;
  const auto refuse = [&](const std::string& text, const std::string& part) {
    folder.write("t.yaml", text);
    test::expect_bad_input([&] { load_tracker_options(folder.path("t.yaml")); }, part);
  };
  refuse("segmentation: 200\n", "t.yaml:1: segmentation: 200: expected a map");
  refuse("matching: oops\n", "t.yaml:1: matching: oops: expected a map");
  refuse("most_points: 9\nsegmentation:\n",
         "t.yaml:2: segmentation: (empty): expected a value; otherwise leave the key out");
  refuse("matching: {max_depth: }\n", "t.yaml:1: matching.max_depth: (empty): expected a value");
  refuse("mathcing:\n", "t.yaml:1: mathcing: unknown key");
  refuse("pose: []\n", "t.yaml:1: pose: a list of 0: expected a map");
  refuse("segmentation: {min_area: 5000, max_area: 10}\n",
         "segmentation: min_area 5000, max_area 10: expected min_area < max_area");
  refuse("segmentation: {min_area: 6000}\n", "min_area 6000, max_area 5000");
  refuse("segmentation: {least_threshold: 50}\n",
         "least_threshold 50, most_threshold 40: expected least_threshold < most_threshold");
  refuse("matching: {max_depth: 0.1}\n", "expected min_depth < max_depth");
  refuse("matching: {max_depth: far}\n",
         "t.yaml:1: matching.max_depth: far: expected a number in [0.01, 1000] [m]");
  refuse("pose: &p {pixel_noise: *p}\n", "nested more than 100 deep");
}

}  // namespace
}  // namespace mocap
}  // namespace anthrob
