#include "status.h"

#include <algorithm>

#include "anthrob_ros/diagnostics.h"

namespace anthrob {
namespace mocap {

namespace {

using diagnostic_msgs::DiagnosticStatus;

void add_value(DiagnosticStatus& status, const std::string& key, const std::string& value) {
  status.values.push_back(key_value(key, value));
}

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

Status::Status(const std::string& name, const StereoRig& rig, const TargetSet& set,
               const TrackerOptions& options, bool recorded)
    : name_(name), recorded_(recorded), health_(rig, matching_of(set, options)) {
  for (const MarkerTarget& target : set.targets) targets_.push_back(target.name);
  for (const BallJoint& joint : set.joints) joints_.push_back(joint.name);
  for (const Stage& stage : tracking_stages(rig, set, options)) stages_.push_back(stage.name);
  clear();
}

void Status::clear() {
  health_.clear();
  processing_.clear(), delay_.clear();
  stage_seconds_.assign(stages_.size(), 0.0);
  seen_.assign(targets_.size(), 0), markers_.assign(targets_.size(), 0);
  refused_ = 0;
  last_refusal_.clear();
}

void Status::add(const StereoFrame& frame, double delay) {
  const std::lock_guard<std::mutex> lock(mutex_);
  health_.add(frame);
  double total = 0.0;
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    stage_seconds_[i] += frame.stage_seconds[i];
    total += frame.stage_seconds[i];
  }
  processing_.push_back(total), delay_.push_back(delay);
  for (std::size_t k = 0; k < targets_.size(); ++k) {
    seen_[k] += frame.targets[k].valid ? 1 : 0;
    markers_[k] += frame.targets[k].markers;
  }
}

void Status::refuse(const std::string& why) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++refused_;
  last_refusal_ = why;
}

DiagnosticStatus Status::report(double elapsed, const std::optional<std::string>& trouble,
                                const Pairing::Counts& images) {
  const std::lock_guard<std::mutex> lock(mutex_);
  DiagnosticStatus status;
  status.name = name_;
  status.hardware_id = "stereo rig";
  judge(trouble, images, status);
  list_values(elapsed, status);
  add_value(status, "lost_images", std::to_string(images.lost));
  clear();
  return status;
}

void Status::judge(const std::optional<std::string>& trouble, const Pairing::Counts& images,
                   DiagnosticStatus& status) const {
  const auto say = [&](const std::optional<std::string>& what) {
    status.message = what.value_or("");
    return what.has_value();
  };
  status.level = DiagnosticStatus::ERROR;
  if (refused_ > 0 ? say(last_refusal_) : say(trouble) || say(health_.contradiction())) return;
  status.level = DiagnosticStatus::WARN;
  if (say(health_.bend()) || say(Pairing::loss(images))) return;
  if (health_.frames() > 0) {
    for (std::size_t k = 0; k < targets_.size(); ++k) {
      if (seen_[k] > 0) continue;
      status.message = targets_[k] + " is not seen";
      if (health_.cut() > 0)
        status.message += "; more points than most_points: the lowest in the picture are ignored";
      if (const auto advice = health_.advice()) status.message = *advice;
      return;
    }
  }
  for (const std::size_t j : health_.unseen_joints()) {
    status.message = joints_[j] + " is not seen: its targets are never seen in the same pair";
    return;
  }
  for (const std::size_t j : health_.joints_without_velocity()) {
    status.message = joints_[j] + " is seen, but never twice within " +
                     text(JointEstimator::kLongestGap) +
                     " s: no velocity, so the joint is not published";
    return;
  }
  if (say(health_.crowd())) return;
  status.level = DiagnosticStatus::OK;
  status.message = health_.frames() > 0 ? "tracking" : "waiting";
}

void Status::list_values(double elapsed, DiagnosticStatus& status) {
  const double frames = std::max(1, health_.frames());
  add_value(status, "rate", text(health_.frames() / elapsed));
  add_value(status, "processing_ms_median", text(1e3 * quantile(processing_, 0.5)));
  add_value(status, "processing_ms_worst", text(1e3 * quantile(processing_, 1.0)));
  if (!recorded_) add_value(status, "exposure_to_result_ms", text(1e3 * quantile(delay_, 0.5)));
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    add_value(status, stages_[i] + "_us", text(1e6 * stage_seconds_[i] / frames));
  }
  for (std::size_t k = 0; k < targets_.size(); ++k) {
    add_value(status, targets_[k] + "_availability", text(seen_[k] / frames));
    add_value(status, targets_[k] + "_markers", text(markers_[k] / frames));
  }
  add_value(status, "residual_px", text(health_.pixel_rms()));
  add_value(status, "row_error_px", text(health_.row_error()));
  add_value(status, "pictures_cut", std::to_string(health_.cut()));
  add_value(status, "searches_given_up", std::to_string(health_.given_up()));
  add_value(status, "refused_images", std::to_string(refused_));
}

}  // namespace mocap
}  // namespace anthrob
