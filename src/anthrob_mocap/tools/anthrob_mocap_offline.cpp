// Tracks targets in recorded pairs of images: the same pipeline as the node's.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "anthrob_core/command_line.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/files.h"
#include "output/pose_table.h"
#include "pipeline/tracker_file.h"
#include "recording.h"

namespace mocap = anthrob::mocap;

namespace {

struct Arguments {
  mocap::Recording recording;
  std::string targets, out, settings, pipeline = "sequential";
  int threshold = 0;
};

/// Frames, availability, residuals and latency, for people.
class Report {
 public:
  explicit Report(const mocap::TargetSet& set) : set_(set), seen_(set.targets.size(), 0) {}

  void add(const mocap::StereoFrame& frame) {
    if (frame.fault) return;
    double total = 0.0;
    for (const double seconds : frame.stage_seconds) total += seconds;
    latency_.push_back(total);
    for (std::size_t k = 0; k < seen_.size(); ++k) seen_[k] += frame.targets[k].valid ? 1 : 0;
  }
  void print(const mocap::Health& health) {
    std::cout << latency_.size() << " pairs";
    for (std::size_t k = 0; k < seen_.size(); ++k) {
      std::cout << ", " << set_.targets[k].name << " in " << seen_[k];
      if (seen_[k] > 0) {
        std::cout << " (residual " << std::round(1e3 * health.residual(k)) / 1e3 << " pixels rms)";
      }
    }
    if (!latency_.empty()) {
      std::nth_element(latency_.begin(), latency_.begin() + latency_.size() / 2, latency_.end());
      std::cout << ", median " << 1e3 * latency_[latency_.size() / 2] << " ms";
    }
    std::cout << "\n";
  }

 private:
  const mocap::TargetSet& set_;
  std::vector<int> seen_;
  std::vector<double> latency_;
};

int track(const Arguments& arguments) {
  const mocap::Recording& recording = arguments.recording;
  mocap::TrackerOptions options;
  if (!arguments.settings.empty()) options = mocap::load_tracker_options(arguments.settings);
  if (arguments.threshold > 0) options.segmentation.threshold = arguments.threshold;
  const auto rig = mocap::StereoRig::load(recording.calibration);
  const auto set = mocap::TargetSet::load(arguments.targets, options.labelling.edge_tolerance);
  mocap::FolderSource source(recording.left, recording.right, recording.folder);
  anthrob::AtomicFile out(arguments.out);
  mocap::PoseTable table(out.stream(), set);
  mocap::Health health(rig, mocap::matching_of(set, options));
  Report report(set);
  mocap::Pipeline pipeline(mocap::tracking_stages(rig, set, options),
                           mocap::pipeline_mode(arguments.pipeline), 8,
                           [&](mocap::PacketPtr packet) {
                             const auto& frame = static_cast<const mocap::StereoFrame&>(*packet);
                             table.add(frame), health.add(frame), report.add(frame);
                           });
  mocap::LeftOut left_out(source.pairs());
  const bool done = mocap::track_all(source, rig, recording, pipeline, left_out);
  if (done) recording.refuse_contradiction(health);
  out.close();
  if (!done) {
    std::cerr << "anthrob_mocap_offline: interrupted; the results so far are in "
              << out.move_beside() << "\n";
    return anthrob::tool::kInterrupted;
  }
  out.move_into_place();
  report.print(health);
  if (source.assumption()) std::cerr << "note: " << *source.assumption() << "\n";
  if (source.loss()) std::cerr << "warning: " << *source.loss() << "\n";
  if (const auto few = left_out.warning()) std::cerr << "warning: " << *few << "\n";
  const auto advice = health.advice(), crowd = health.crowd();
  if (advice) std::cerr << "no pose: " << *advice << "\n";
  if (health.given_up() > 0) {
    std::cerr << "warning: " << health.given_up()
              << " searches of targets were given up at step_limit: too many bright blobs\n";
  }
  if (crowd && crowd != advice) std::cerr << "warning: " << *crowd << "\n";
  if (const auto bend = health.bend()) std::cerr << "warning: " << *bend << "\n";
  return anthrob::tool::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Tracks marker targets in pairs of images; writes poses and ball joints as CSV.",
               "anthrob_mocap_offline");
  Arguments a;
  a.recording.add_options(app);
  app.add_option("--targets", a.targets, "targets.yaml")->required();
  app.add_option("--out", a.out, "poses.csv to write")->required();
  app.add_option("--settings", a.settings, "options of the stages (YAML)");
  app.add_option("--threshold", a.threshold,
                 "grey levels above the background, not by the noise of the pictures; overrides "
                 "segmentation.threshold of --settings")
      ->check(CLI::Range(1, 254));
  app.add_option("--rate", a.recording.folder.rate, "pairs a second, if there is no times.csv")
      ->check(anthrob::tool::within(0.001, 100000.0));
  app.add_option("--pipeline", a.pipeline, "sequential or threaded: same results");
  return anthrob::tool::run(app, argc, argv, [&] { return track(a); });
}
