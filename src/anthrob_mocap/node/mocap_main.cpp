#include "anthrob_core/errors.h"
#include "anthrob_ros/parameters.h"
#include "anthrob_ros/run_node.h"
#include "mocap_node.h"
#include "open_source.h"
#include "pipeline/tracker_file.h"

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
    throw anthrob::BadInput(
        "parameter ~joint_tf: true: expected parameter ~rig as well; rig.yaml says where the "
        "joints are");
  }
  const std::string calibration = optional_text(settings, "calibration");
  const std::string source = optional_text(settings, "source", "topics");
  if (source != "topics" && calibration.empty()) {
    throw anthrob::BadInput(
        "parameter ~calibration: missing; expected a folder with left.yaml and right.yaml "
        "(only source topics can take the calibration from camera_info)");
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
  info.purpose =
      "Tracks marker targets in the images of two cameras; publishes their poses and ball joints.";
  info.parameters = {
      {"targets", "path of targets.yaml (required)"},
      {"rig",
       "path of rig.yaml: where the cameras, targets and joints are on the robot; needed for tf "
       "of the camera and for joint_tf (default: none)"},
      {"calibration",
       "folder with left.yaml and right.yaml; empty, only with source topics: taken from "
       "camera_info (default: empty)"},
      {"settings", "path of a YAML file with options of the stages (default: none)"},
      {"source", "topics, folder, bag, aravis or dc1394 (default: topics)"},
      {"left",
       "source folder: folder of images; bag: image topic; aravis, dc1394: name or GUID of the "
       "camera"},
      {"right", "the same for the right camera"},
      {"bag", "source bag: path of the bag"},
      {"rate",
       "[Hz] frame rate of a folder without times.csv, or of cameras, triggered or free (default: "
       "60)"},
      {"trigger",
       "aravis: software, free or the name of a trigger line (default: software); dc1394: external "
       "or free (default: external)"},
      {"exposure", "[s] exposure of the cameras (default: 0.0005)"},
      {"pipeline", "sequential or threaded; same results (default: sequential)"},
      {"sync_tolerance",
       "[s] largest difference between the stamps of a pair; 0 is the source's own default: topics "
       "and bag: equal stamps; folder: 0.002; aravis and dc1394: 0.004, or half a period if that "
       "is shorter (default: 0)"},
      {"camera_frame", "tf frame of the rectified left camera (default: mocap_camera)"},
      {"joint_tf", "whether to publish the links of the joints in tf (default: false)"},
  };
  return anthrob::run_node(argc, argv, info, [](ros::NodeHandle& nh, ros::NodeHandle& settings) {
    track(nh, settings);
    return 0;
  });
}
