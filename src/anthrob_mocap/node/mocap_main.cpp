#include "anthrob_mocap/pipeline/tracker_file.h"
#include "mocap_node.h"
#include "open_source.h"
#include "parameters.h"

namespace mocap = anthrob::mocap;

namespace {

mocap::MocapNode::Options read_options(const ros::NodeHandle& settings) {
  mocap::MocapNode::Options options;
  const std::string tracker = settings.param<std::string>("settings", "");
  if (!tracker.empty()) options.tracker = mocap::load_tracker_options(tracker);
  options.mode = mocap::pipeline_mode(settings.param<std::string>("pipeline", "sequential"));
  settings.param("camera_frame", options.camera_frame, options.camera_frame);
  settings.param("sync_tolerance", options.sync_tolerance, options.sync_tolerance);
  settings.param("joint_tf", options.joint_tf, options.joint_tf);
  if (!(options.sync_tolerance >= 0.0)) {
    throw mocap::BadInput("parameter ~sync_tolerance: expected a number >= 0 [s]");
  }
  return options;
}

void track(ros::NodeHandle& nh, ros::NodeHandle& settings) {
  const auto options = read_options(settings);
  const auto set =
      mocap::TargetSet::load(mocap::required(settings, "targets", "the path of targets.yaml"),
                             options.tracker.labelling.edge_tolerance);
  std::optional<mocap::Setup> setup;
  const std::string rig_file = settings.param<std::string>("rig", "");
  if (!rig_file.empty()) setup = mocap::Setup::load(rig_file, set);
  const std::string calibration = settings.param<std::string>("calibration", "");
  const std::string source = settings.param<std::string>("source", "topics");
  if (source != "topics" && calibration.empty()) {
    throw mocap::BadInput(
        "parameter ~calibration: missing; expected a folder with left.yaml and "
        "right.yaml");
  }
  const mocap::StereoRig rig = calibration.empty()
                                   ? mocap::wait_for_rig(ros::NodeHandle(nh, "mocap"))
                                   : mocap::StereoRig::load(calibration);
  mocap::MocapNode node(nh, rig, set, setup, options);
  if (source == "topics") {
    node.run();
  } else {
    node.run(*mocap::open_source(source, rig, settings));
  }
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "mocap");
  return mocap::run_node([] {
    ros::NodeHandle nh, settings("~");
    track(nh, settings);
  });
}
