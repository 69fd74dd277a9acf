// Latency of every stage, and throughput against targets and reflections: what the node does with a
// pair of 648x488 pixels, on one core.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <opencv2/imgproc.hpp>
#include <random>

#include "support.h"

namespace anthrob {
namespace mocap {
namespace {

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Of this thread: what others on the machine do does not count.
double processor_time() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The two targets of the tests, or one of them, or copies of both, scaled so that they differ.
TargetSet make_targets(int count) {
  TargetSet set = test::make_targets();
  if (count < 2) set.targets.resize(1), set.joints.clear();
  for (int k = 2; k < count; ++k) {
    MarkerTarget target = set.targets[static_cast<std::size_t>(k % 2)];
    target.name += std::to_string(k);
    for (Vec3& m : target.markers) m *= 1.0 - 0.12 * (k / 2);
    set.targets.push_back(target);
  }
  return set;
}

std::vector<Pose> poses_at(double t, std::size_t count) {
  static const test::Motion motion = test::swing(0.5, 1.0);
  const std::vector<Pose> two = motion(t);
  std::vector<Pose> poses;
  for (std::size_t k = 0; k < count; ++k) {
    poses.push_back(two[k % 2]);
    if (k >= 2) poses.back().p += Vec3(k % 4 < 2 ? -0.15 : 0.12, k < 4 ? 0.1 : -0.1, 0.1);
  }
  return poses;
}

/// Pairs with all targets and `blobs` reflections in view: left, right, left, ...
std::vector<Image> render(const StereoRig& rig, const TargetSet& set, int blobs, int pairs) {
  Renderer renderer(rig, RenderOptions());
  std::mt19937_64 random(8);
  std::vector<Image> images(2 * static_cast<std::size_t>(pairs));
  for (std::size_t i = 0; i < images.size(); i += 2) {
    Scene scene = test::scene_of(set, poses_at(static_cast<double>(i) / 120.0, set.targets.size()));
    test::add_distractors(scene, blobs, random);
    for (const Side side : {kLeft, kRight}) renderer.render(side, {scene}, i, images[i + side]);
  }
  return images;
}

/// What each pair took, by stage and in all.
struct Profile {
  std::vector<std::vector<double>> stages;
  std::vector<double> total, processor;
  std::int64_t poses = 0;

  void add(const StereoFrame& frame) {
    stages.resize(frame.stage_seconds.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < stages.size(); ++i) {
      stages[i].push_back(frame.stage_seconds[i]);
      sum += frame.stage_seconds[i];
    }
    total.push_back(sum);
    for (const TargetPose& pose : frame.targets) poses += pose.valid ? 1 : 0;
  }
};

void report(benchmark::State& state, const Pipeline& pipeline, const Profile& profile) {
  const auto put = [&](const std::string& what, const std::vector<double>& seconds) {
    state.counters[what + "_us"] = 1e6 * quantile(seconds, 0.5);
    state.counters[what + "_99_us"] = 1e6 * quantile(seconds, 0.99);
  };
  for (std::size_t i = 0; i < profile.stages.size(); ++i) {
    put(pipeline.stages()[i].name, profile.stages[i]);
  }
  put("total", profile.total);
  put("processor", profile.processor);
  state.counters["poses_per_pair"] =
      static_cast<double>(profile.poses) / static_cast<double>(state.iterations());
}

/// @param state range 0: targets of five markers, range 1: reflections
void track(benchmark::State& state) {
  const StereoRig rig = test::make_rig();
  const TargetSet set = make_targets(static_cast<int>(state.range(0)));
  const std::vector<Image> images = render(rig, set, static_cast<int>(state.range(1)), 60);
  Profile profile;
  Pipeline pipeline(tracking_stages(rig, set, {}), PipelineMode::kSequential, 1,
                    [&](PacketPtr packet) { profile.add(static_cast<StereoFrame&>(*packet)); });
  std::size_t i = 0;
  for (auto _ : state) {
    auto frame = std::make_unique<StereoFrame>();
    frame->t = static_cast<double>(i) / 60.0;
    for (const Side side : {kLeft, kRight}) {
      frame->image[side] = images[(2 * i + side) % images.size()].view();
    }
    ++i;
    const double start = processor_time();
    pipeline.push(std::move(frame));
    profile.processor.push_back(processor_time() - start);
  }
  report(state, pipeline, profile);
}
BENCHMARK(track)
    ->ArgsProduct({{1, 2, 4, 6}, {0, 10, 30, 60}})
    ->ArgNames({"targets", "blobs"})
    ->Unit(benchmark::kMicrosecond);

/// The first stage alone, done by OpenCV's functions: a yardstick of the machine.
void opencv_segmentation(benchmark::State& state) {
  const std::vector<Image> images = render(test::make_rig(), make_targets(2), 10, 60);
  cv::Mat binary, labels, stats, centroids;
  std::size_t i = 0;
  for (auto _ : state) {
    for (const Side side : {kLeft, kRight}) {
      const Image& image = images[(i + side) % images.size()];
      const cv::Mat grey(image.height, image.width, CV_8U,
                         const_cast<std::uint8_t*>(image.pixels.data()));
      cv::threshold(grey, binary, 52.0, 255.0, cv::THRESH_BINARY);
      cv::connectedComponentsWithStats(binary, labels, stats, centroids, 8);
    }
    i += 2;
  }
}
BENCHMARK(opencv_segmentation)->Unit(benchmark::kMicrosecond);

/// The thesis's way: threshold, findContours, moments of the contours.
void opencv_contours(benchmark::State& state) {
  const std::vector<Image> images = render(test::make_rig(), make_targets(2), 10, 60);
  cv::Mat binary;
  std::vector<std::vector<cv::Point>> contours;
  std::size_t i = 0;
  for (auto _ : state) {
    for (const Side side : {kLeft, kRight}) {
      const Image& image = images[(i + side) % images.size()];
      const cv::Mat grey(image.height, image.width, CV_8U,
                         const_cast<std::uint8_t*>(image.pixels.data()));
      cv::threshold(grey, binary, 52.0, 255.0, cv::THRESH_BINARY);
      cv::findContours(binary, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
      for (const auto& contour : contours) benchmark::DoNotOptimize(cv::moments(contour));
    }
    i += 2;
  }
}
BENCHMARK(opencv_contours)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace mocap
}  // namespace anthrob
