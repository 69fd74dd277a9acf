// Measures where the markers of a target are, from a recording in which both cameras see them.
#include <cstdio>
#include <iostream>
#include <optional>

#include "anthrob_core/command_line.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/files.h"
#include "calibration/target_calibration.h"
#include "pipeline/tracker_file.h"
#include "recording.h"

namespace mocap = anthrob::mocap;

namespace {

struct Arguments {
  mocap::Recording recording;
  std::string targets, name, out, settings;
};

/// Points in space of every pair of images; nothing if interrupted.
std::optional<std::vector<std::vector<mocap::MarkerPoint>>> read_points(
    const mocap::Recording& recording, const mocap::TargetSet& set,
    const mocap::TrackerOptions& options) {
  const auto rig = mocap::StereoRig::load(recording.calibration);
  std::vector<std::vector<mocap::MarkerPoint>> frames;
  mocap::Health health(rig, mocap::matching_of(set, options));
  mocap::Pipeline pipeline(mocap::tracking_stages(rig, set, options),
                           mocap::PipelineMode::kSequential, 1, [&](mocap::PacketPtr packet) {
                             const auto& frame = static_cast<mocap::StereoFrame&>(*packet);
                             health.add(frame), frames.push_back(frame.points);
                           });
  mocap::FolderSource source(recording.left, recording.right, recording.folder);
  mocap::LeftOut left_out(source.pairs());
  if (!mocap::track_all(source, rig, recording, pipeline, left_out)) return std::nullopt;
  recording.refuse_contradiction(health);
  if (source.assumption()) std::cerr << "note: " << *source.assumption() << "\n";
  if (source.loss()) std::cerr << "warning: " << *source.loss() << "\n";
  if (const auto few = left_out.warning()) std::cerr << "warning: " << *few << "\n";
  if (const auto crowd = health.crowd()) std::cerr << "warning: " << *crowd << "\n";
  // Markers need not fit yet.
  if (const auto uneven = health.uneven_rows()) std::cerr << "warning: " << *uneven << "\n";
  return frames;
}

/// Warns of targets that are still ambiguous: their positions may be guesses, not calibrated yet.
void note_others(const mocap::TargetSet& set, const std::string& name, double edge_tolerance) {
  for (const mocap::MarkerTarget& a : set.targets) {
    for (const mocap::MarkerTarget& b : set.targets) {
      const auto why = mocap::find_ambiguity(a, b, edge_tolerance);
      if (why && !(a.name == name && b.name == name)) {
        std::cerr << "cannot be tracked yet: target " << a.name << ": " << *why << "\n";
      }
    }
  }
  const int triples = mocap::count_ambiguous_triples(set.targets, edge_tolerance);
  if (triples > 0) {
    std::cerr << "note: " << triples
              << " triples of markers can be taken for others: a target of which "
              << "only such a triple is seen gets no pose\n";
  }
}

int calibrate(const Arguments& arguments) {
  mocap::TrackerOptions options;
  if (!arguments.settings.empty()) options = mocap::load_tracker_options(arguments.settings);
  const double edge_tolerance = options.labelling.edge_tolerance;
  // A guess may look ambiguous; the result must not.
  mocap::TargetSet set = mocap::TargetSet::load(arguments.targets, mocap::TargetSet::kUnchecked);
  for (mocap::MarkerTarget& target : set.targets) {
    if (target.name != arguments.name) continue;
    const auto points = read_points(arguments.recording, set, options);
    if (!points) return anthrob::tool::kInterrupted;
    const auto result = mocap::calibrate_target(target, *points);
    if (anthrob::tool::interrupted()) return anthrob::tool::kInterrupted;
    for (std::size_t i = 0; i < result.seen.size(); ++i) {
      std::printf("marker %zu: moved by %.2f mm, seen in %d frames, %.3f mm rms\n", i,
                  1e3 * (result.target.markers[i] - target.markers[i]).norm(), result.seen[i],
                  1e3 * result.rms[i]);
    }
    std::printf("%d frames\n", result.frames);
    target = result.target;
    const std::string text = set.to_yaml();
    mocap::TargetSet::parse(text, arguments.out, mocap::TargetSet::kUnchecked);
    if (const auto why = mocap::find_ambiguity(target, target, edge_tolerance)) {
      throw anthrob::BadInput("target " + target.name + ": " + *why);
    }
    anthrob::write_file_atomically(arguments.out, text);
    note_others(set, target.name, edge_tolerance);
    return anthrob::tool::kDone;
  }
  throw anthrob::BadInput("--name " + arguments.name + ": no such target in " + arguments.targets);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Measures where the markers of a target are, from a recording in which both cameras see "
      "each marker in 20 frames or more. The target may move or stand still.",
      "anthrob_mocap_calibrate_target");
  Arguments a;
  a.recording.add_options(app);
  app.add_option("--targets", a.targets,
                 "targets.yaml with the markers as measured by hand, to a centimetre")
      ->required();
  app.add_option("--name", a.name, "the target to calibrate")->required();
  app.add_option("--out", a.out, "targets.yaml to write")->required();
  app.add_option("--settings", a.settings, "options of the stages (YAML)");
  return anthrob::tool::run(app, argc, argv, [&] { return calibrate(a); });
}
