// A long run of frames leaves the size of the process as it was. ANTHROB_MOCAP_SOAK sets the number
// of pairs: 5184000 are a day at 60 Hz.
#include <gtest/gtest.h>
#include <malloc.h>

#include <cstdio>
#include <cstdlib>

#include "pipeline/health.h"
#include "source/live_pair.h"
#include "support.h"

namespace anthrob {
namespace mocap {
namespace {

constexpr int kScenes = 24;

/// What was asked for and not given back. The process does not grow while there is room in what it
/// once needed: its size alone does not show some hundred kilobytes.
double heap_megabytes() {
#if __GLIBC_PREREQ(2, 33)
  const auto all = mallinfo2();
#else
  const auto all = mallinfo();
#endif
  return static_cast<double>(all.uordblks + all.hblkhd) / 1048576.0;
}

/// All that happens to a rig: motion, reflections, occlusion, daylight, a lens cap.
std::vector<std::shared_ptr<Image>> render(const StereoRig& rig, const TargetSet& set) {
  Renderer renderer(rig, RenderOptions());
  std::mt19937_64 random(3);
  const test::Motion motion = test::swing(0.6, 2.0);
  std::vector<std::shared_ptr<Image>> images;
  for (std::uint64_t i = 0; i < kScenes; ++i) {
    Scene scene = test::scene_of(set, motion(static_cast<double>(i) / 10.0));
    test::add_distractors(scene, static_cast<int>(random() % 20), random);
    if (i % 8 == 5) scene.spheres.resize(3 + random() % 6);
    if (i % 12 == 7) scene.spheres.clear();
    for (const Side side : {kLeft, kRight}) {
      images.push_back(std::make_shared<Image>());
      renderer.render(side, {scene}, i, *images.back());
      if (i == 20) {
        for (auto& pixel : images.back()->pixels) pixel = static_cast<std::uint8_t>(random());
      }
    }
  }
  return images;
}

class Soak : public ::testing::TestWithParam<PipelineMode> {};

TEST_P(Soak, DoesNotGrow) {
  const char* wanted = std::getenv("ANTHROB_MOCAP_SOAK");
  const long pairs = wanted ? std::atol(wanted) : 4000;
  const StereoRig rig = test::make_rig();
  const TargetSet set = test::make_targets();
  const auto images = render(rig, set);
  Health health(rig, MatchingOptions());
  LivePair live(0.002);
  long poses = 0;
  {
    Pipeline pipeline(tracking_stages(rig, set, {}), GetParam(), 4, [&](PacketPtr packet) {
      const auto& frame = static_cast<const StereoFrame&>(*packet);
      health.add(frame);
      for (const TargetPose& target : frame.targets) poses += target.valid ? 1 : 0;
    });
    double before = 0.0, heap_before = 0.0;
    for (long i = 0; i < pairs; ++i) {
      for (const Side side : {kLeft, kRight}) {
        if (i % 101 == 50 && side == kRight) continue;  // lost on the way
        const auto& image = images[static_cast<std::size_t>(2 * (i % kScenes)) + side];
        live.add(side, {static_cast<double>(i) / 60.0, i * 1000000000 / 60, image->view(), image});
      }
      auto frame = std::make_unique<StereoFrame>();
      if (live.next(*frame, 0.0)) pipeline.push(std::move(frame));
      if (i == pairs / 4) {
        pipeline.drain();
        before = test::resident_bytes() / 1048576.0;
        heap_before = heap_megabytes();
      }
    }
    pipeline.drain();
    const double after = test::resident_bytes() / 1048576.0, heap_after = heap_megabytes();
    std::printf(
        "%ld pairs, %ld poses: %.1f MB after a quarter, %.1f MB at the end; heap %.3f, %.3f\n",
        pairs, poses, before, after, heap_before, heap_after);
    EXPECT_LT(after, before + 2.0);
    EXPECT_LT(heap_after, heap_before + 0.05);
  }
  EXPECT_GT(poses, pairs);
  for (const auto& image : images) EXPECT_LE(image.use_count(), 2);  // the last may still wait
}

INSTANTIATE_TEST_SUITE_P(Modes, Soak,
                         ::testing::Values(PipelineMode::kSequential, PipelineMode::kThreaded),
                         [](const auto& mode) {
                           return mode.param == PipelineMode::kThreaded ? "threaded" : "sequential";
                         });

}  // namespace
}  // namespace mocap
}  // namespace anthrob
