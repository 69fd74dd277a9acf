#include "anthrob_config/errors.h"
#include "anthrob_mocap/pipeline/tracker_file.h"
#include "anthrob_ros/parameters.h"
#include "anthrob_ros/run_node.h"
#include "mocap_node.h"
#include "open_source.h"

namespace mocap = anthrob::mocap;

namespace {

/// @param text if it is not there
std::string optional_text(const ros::NodeHandle& settings, const std::string& key,
                          std::string text = "") {
  anthrob::take(settings, key, anthrob::text_of, text);
  return text;
}

mocap::MocapNode::Options read_options(const ros::NodeHandle& settings) {
  mocap::MocapNode::Options options;
  const std::string tracker = optional_text(settings, "settings");
  if (!tracker.empty()) options.tracker = mocap::load_tracker_options(tracker);
  options.mode = mocap::pipeline_mode(optional_text(settings, "pipeline", "sequential"));
  anthrob::take(settings, "camera_frame", anthrob::text_of, options.camera_frame);
  anthrob::take(settings, "sync_tolerance", anthrob::nonnegative_number_of, options.sync_tolerance);
  anthrob::take(settings, "joint_tf", anthrob::truth_of, options.joint_tf);
  const std::string source = optional_text(settings, "source", "topics");
  options.recorded = source == "folder" || source == "bag";
  return options;
}

void track(ros::NodeHandle& nh, ros::NodeHandle& settings) {
  const auto options = read_options(settings);
  const auto set =
      mocap::TargetSet::load(anthrob::required(settings, "targets", "the path of targets.yaml"),
                             options.tracker.labelling.edge_tolerance);
  std::optional<mocap::Setup> setup;
  const std::string rig_file = optional_text(settings, "rig");
  if (!rig_file.empty()) setup = mocap::Setup::load(rig_file, set);
  if (options.joint_tf && !setup) {
    throw anthrob::BadInput("parameter ~joint_tf: true needs ~rig, which says where joints are");
  }
  const std::string calibration = optional_text(settings, "calibration");
  const std::string source = optional_text(settings, "source", "topics");
  if (source != "topics" && calibration.empty()) {
    throw anthrob::BadInput(
        "parameter ~calibration: missing; expected a folder with left.yaml and "
        "right.yaml");
  }
  const std::optional<mocap::StereoRig> rig =
      calibration.empty() ? mocap::wait_for_rig(ros::NodeHandle(nh, "mocap"))
                          : mocap::StereoRig::load(calibration);
  if (!rig) return;  // stopped while it waited
  mocap::MocapNode node(nh, *rig, set, setup, options);
  if (source == "topics") {
    node.run();
  } else {
    node.run(*mocap::open_source(source, *rig, settings,
                                 [&](const std::string& why) { node.refuse(why); }));
  }
}

}  // namespace

int main(int argc, char** argv) {
  anthrob::NodeInfo info;
  info.name = "mocap";
  info.purpose = "Stereo infrared markers to poses of targets and ball joints.";
  info.parameters = {
      {"targets", "path of targets.yaml (required)"},
      {"rig", "path of rig.yaml: where the targets sit on the robot (default: none, poses only)"},
      {"calibration", "folder with left.yaml and right.yaml (default: what camera_info says)"},
      {"settings", "path of the tracker's settings (default: none)"},
      {"source", "topics, folder, bag, aravis or dc1394 (default: topics)"},
      {"left", "of another source than topics: folder, topic or camera"},
      {"right", "likewise"},
      {"bag", "path of a bag, of source bag"},
      {"rate",
       "[Hz] of a folder without times.csv, or at which cameras are triggered (default: 60)"},
      {"trigger",
       "of aravis: software, free or a line; of dc1394: external or free (default: the first of "
       "these)"},
      {"exposure", "[s] of cameras (default: 0.0005)"},
      {"pipeline", "sequential or threaded (default: sequential)"},
      {"sync_tolerance", "[s] between stamps of a pair, 0: as the source wants it (default: 0)"},
      {"camera_frame", "frame of the left camera, rectified (default: mocap_camera)"},
      {"joint_tf", "whether the joints go to tf, too (default: false)"},
  };
  return anthrob::run_node(argc, argv, info, [](ros::NodeHandle& nh, ros::NodeHandle& settings) {
    track(nh, settings);
    return 0;
  });
}
