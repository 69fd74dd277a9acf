#include "pipeline/tracker.h"

namespace anthrob {
namespace mocap {

namespace {

/// A stage of one lane that works on frames.
template <typename Work>
Stage stage(const std::string& name, Work work) {
  return {name, {[work](Packet& packet) { work(static_cast<StereoFrame&>(packet)); }}};
}

/// A stage that treats both sides alike, each in a lane.
template <typename Work>
Stage stage_by_side(const std::string& name, Work left, Work right) {
  return {name,
          {[left](Packet& packet) { left(static_cast<StereoFrame&>(packet), kLeft); },
           [right](Packet& packet) { right(static_cast<StereoFrame&>(packet), kRight); }}};
}

auto segmentation(const SegmentationOptions& options) {
  auto segmenter = std::make_shared<Segmenter>(options);
  return [segmenter](StereoFrame& frame, Side side) {
    frame.cluttered[side] = !segmenter->find(frame.image[side], frame.blobs[side]);
    if (frame.cluttered[side]) frame.blobs[side].clear();
  };
}

auto undistortion(const StereoRig& rig) {
  return [rig](StereoFrame& frame, Side side) {
    frame.rectified[side].clear();
    for (const Blob& blob : frame.blobs[side]) {
      frame.rectified[side].push_back(rig.rectify(side, blob.centre));
    }
  };
}

}  // namespace

MatchingOptions matching_of(const TargetSet& targets, const TrackerOptions& options) {
  MatchingOptions matching = options.matching;
  matching.marker_diameter = targets.marker_diameter;
  return matching;
}

std::vector<Stage> tracking_stages(const StereoRig& rig, const TargetSet& set,
                                   const TrackerOptions& options) {
  const auto matcher = std::make_shared<EpipolarMatcher>(rig, matching_of(set, options));
  const Triangulator triangulator(rig, 0.5 * set.marker_diameter);
  const auto labeller = std::make_shared<Labeller>(set.targets, options.labelling, options.motion);
  const PoseEstimator pose_estimator(rig, set.targets, options.pose);
  const auto joints = std::make_shared<std::vector<JointEstimator>>();
  for (const BallJoint& joint : set.joints) joints->emplace_back(joint);
  const std::size_t most_points = static_cast<std::size_t>(options.most_points);

  return {
      stage_by_side("segmentation", segmentation(options.segmentation),
                    segmentation(options.segmentation)),
      stage_by_side("undistortion", undistortion(rig), undistortion(rig)),
      stage("matching",
            [matcher](StereoFrame& frame) {
              matcher->match(frame.blobs, frame.rectified, frame.matches);
            }),
      stage("triangulation",
            [triangulator, most_points](StereoFrame& frame) {
              frame.cut = frame.matches.size() > most_points;
              if (frame.cut) frame.matches.resize(most_points);
              triangulator.triangulate(frame.rectified, frame.matches, frame.points);
            }),
      stage("edges",
            [labeller](StereoFrame& frame) {
              find_edges(frame.points, labeller->longest_edge(), frame.edges);
            }),
      stage("labelling",
            [labeller](StereoFrame& frame) {
              labeller->label(frame.t, frame.points, frame.cut, frame.edges, frame.labels);
            }),
      stage("pose",
            [pose_estimator](StereoFrame& frame) {
              frame.targets.resize(frame.labels.size());
              for (std::size_t k = 0; k < frame.labels.size(); ++k) {
                frame.targets[k] =
                    pose_estimator.estimate(static_cast<int>(k), frame.labels[k], frame.points);
              }
            }),
      stage("joint",
            [joints](StereoFrame& frame) {
              frame.joints.clear();
              for (JointEstimator& estimator : *joints) {
                const BallJoint& joint = estimator.joint();
                frame.joints.push_back(estimator.estimate(
                    frame.t, frame.targets[static_cast<std::size_t>(joint.parent)],
                    frame.targets[static_cast<std::size_t>(joint.child)]));
              }
            }),
  };
}

}  // namespace mocap
}  // namespace anthrob
