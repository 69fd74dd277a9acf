#include "experiment/pose_experiment.h"

#include <cmath>

#include "anthrob_calib/resume/fingerprint.h"
#include "experiment/hidden_inertia.h"
#include "experiment/poses.h"

namespace anthrob {
namespace discovery {

PoseExperiment::PoseExperiment(const RobotModel& model, const Dataset& recording,
                               const PoseOptions& options)
    : options_(options) {
  const Dataset poses = ordered_poses(model, recording, options);
  name_ = recording.folder;
  known_numbers_ = recording.meta.model;
  of_poses_ = true;
  bin_ = options.seconds;
  poses_ = poses.tables.front().t.size();
  duration_ = static_cast<double>(poses_) * bin_;
  fingerprint_ = resume::Fingerprint().add(poses).add(bin_).value();
  const auto& joints = model.skeleton->joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const JointModel& joint = joints[j];
    if (!joint.driven) continue;
    const auto values = [&](const char* quantity) {
      std::vector<double> found = poses.series(joint.name + quantity).values;
      return found.empty() ? std::vector<double>(poses_, 0.0) : found;
    };
    axes_.push_back({static_cast<int>(j), values("/position"), values("/direction"),
                     values("/effort"), values("/load")});
    channels_.push_back({joint.name, kEffortAtRest, joint.type == JointType::kHinge ? "Nm" : "N", 0,
                         present_.size(), poses_});
    present_.insert(present_.end(), poses_, 1);
    // A joint that friction may hold shows nothing of the noise.
    for (const double direction : axes_.back().direction) telling_.push_back(direction != 0.0);
  }
  bool any = false;
  for (const char telling : telling_) any = any || telling;
  if (!any) telling_.clear();
}

void PoseExperiment::approach(Simulation& sim, std::size_t pose) const {
  std::vector<double> q = sim.model().skeleton->rest_configuration();
  const auto put = [&](double before) {
    for (const Axis& axis : axes_) {
      const JointModel& joint = sim.model().skeleton->joints[static_cast<std::size_t>(axis.joint)];
      q[static_cast<std::size_t>(joint.position_offset)] =
          axis.position[pose] - axis.direction[pose] * before;
    }
  };
  // The last two steps creep, the second of them without acceleration.
  const double creep = options_.creep * sim.step_length();
  put(options_.approach + 2.0 * creep);
  sim.place(q, {});
  for (const Axis& axis : axes_) {
    sim.apply_effort(axis.joint, axis.effort[pose]);
    sim.apply_load(axis.joint, axis.load[pose]);
  }
  for (int left = options_.approach_steps - 1; left >= -2; --left) {
    put(left >= 0 ? options_.approach * left / options_.approach_steps + 2.0 * creep
                  : creep * (left + 2));
    sim.imposed_posture().impose(q);
    sim.step();
  }
}

double PoseExperiment::missing_effort(const Simulation& sim, const Axis& axis,
                                      double direction) const {
  const auto lacking = sim.lacking_effort(axis.joint, 0.5 * options_.creep);
  if (direction != 0.0) return beyond_zero(lacking.range.low, lacking.range.high);
  // Nothing tells how friction that bends before it slides was bent.
  const JointModel& joint = sim.model().skeleton->joints[static_cast<std::size_t>(axis.joint)];
  double bent = 0.0;
  for (const BristleModel& bristles : joint.friction.bristles) {
    bent += bristles.torque * bristles.static_ratio / joint.effort_gain;
  }
  return beyond_zero(lacking.range.low - bent, lacking.range.high + bent);
}

void PoseExperiment::compare(const std::shared_ptr<const RobotModel>& model, const Starts&,
                             float* out) const {
  Simulation sim(model);
  for (std::size_t pose = 0; pose < poses_; ++pose) {
    approach(sim, pose);
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      out[channels_[a].offset + pose] =
          static_cast<float>(missing_effort(sim, axes_[a], axes_[a].direction[pose]));
    }
  }
}

}  // namespace discovery
}  // namespace anthrob
