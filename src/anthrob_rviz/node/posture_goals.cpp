#include "posture_goals.h"

#include <anthrob_msgs/GoTo.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <utility>

#include "anthrob_core/monotonic_clock.h"
#include "marker_messages.h"

namespace anthrob {
namespace {

using visualization_msgs::Marker;

const char* const kGoTo = "controller/go_to";
const char* const kSearch = "search";  // among the calls; no service has that name
constexpr double kSearchPeriod = 2.0;  // [s] between two questions to the master
constexpr double kGhostPeriod = 0.1;   // [s]
constexpr double kAnswerLimit = 2.0;   // [s]
constexpr double kSpeed = 0.8;         // [rad/s, m/s] mean on the way to the goal
constexpr double kShortest = 1.5;      // [s]
constexpr double kArrived = 0.05;      // [rad, m]
constexpr double kOverdue = 5.0;       // [s] after the end of the way: the muscles cannot hold it

anthrob_msgs::GoTo request_of(const Skeleton& skeleton, const GoalPosture& goal, double duration) {
  anthrob_msgs::GoTo go;
  go.request.duration = duration;
  for (const auto& [link, asked] : goal.asked()) {
    const LinkJoint& joint = skeleton.links()[link].joint;
    if (joint.kind == JointKind::kBall) {
      go.request.ball_joint_name.push_back(joint.name);
      Pose turned;
      turned.R = asked.position.rotation.toRotationMatrix();
      go.request.ball_joint_orientation.push_back(message_of(turned).orientation);
    } else {
      go.request.joint_name.push_back(joint.name);
      go.request.joint_position.push_back(asked.position.q);
    }
  }
  return go;
}

}  // namespace

PostureGoals::PostureGoals(ros::NodeHandle& nh, const Skeleton& skeleton, const PostureInput& input)
    : nh_(nh),
      skeleton_(skeleton),
      input_(input),
      goal_(skeleton),
      server_("posture"),
      ghost_(nh_.advertise<visualization_msgs::MarkerArray>("posture/ghost", 10)) {
  menu_.insert("Go there", [this](const auto&) { send(); });
  menu_.insert("Forget", [this](const auto&) { forget(); });
}

// ---- what the window says

void PostureGoals::hear(const Feedback& feedback) {
  const auto link = skeleton_.find(feedback.marker_name);
  if (!link || !offered_ || input_.history().empty()) return;
  if (feedback.event_type == Feedback::MOUSE_UP) dragged_.reset();
  if (feedback.event_type != Feedback::POSE_UPDATE) return;
  const auto X_WC = pose_from(feedback.pose);
  if (!X_WC) return;
  dragged_ = link;
  phase_ = Phase::kPlanning;
  goal_.ask(*link, *X_WC, input_.history().newest());
}

void PostureGoals::forget() {
  goal_.forget();
  dragged_.reset();
  phase_ = Phase::kPlanning;
  Marker all;
  all.header.frame_id = skeleton_.links()[0].name;
  all.action = Marker::DELETEALL;
  visualization_msgs::MarkerArray none;
  none.markers.push_back(all);
  ghost_.publish(none);
}

void PostureGoals::send() {
  if (goal_.empty() || phase_ == Phase::kAsking) return;
  const double now = monotonic_now();
  const double duration = std::max(kShortest, goal_.way(input_.history().newest()) / kSpeed);
  const std::string service = nh_.resolveName(kGoTo);
  const auto call = [service, go = request_of(skeleton_, goal_, duration)]() mutable {
    if (!ros::service::call(service, go)) return CallResult{kGoTo, false, "the call failed"};
    return CallResult{kGoTo, go.response.success != 0, go.response.message};
  };
  if (!calls_.start(kGoTo, call, kAnswerLimit, now)) return;
  phase_ = Phase::kAsking;
  end_of_way_ = now + duration;
}

// ---- what the robot says

void PostureGoals::look() {
  const double now = monotonic_now();
  hear_answers(now);
  survey(now);
  if (now < next_picture_ || !offered_ || input_.history().empty()) return;
  next_picture_ = now + kGhostPeriod;
  follow(now);
  move_handles();
  if (!goal_.empty()) draw_ghost();
}

void PostureGoals::hear_answers(double now) {
  for (const CallResult& answer : calls_.finished(now)) {
    if (answer.service == kSearch) {
      if (answer.success && !offered_) offer();
      if (!answer.success && offered_) withdraw();
    } else if (phase_ == Phase::kAsking) {
      phase_ = answer.success ? Phase::kGoing : Phase::kRefused;
      answer_ = answer.message;
      if (!answer.success) ROS_WARN_STREAM(kGoTo << ": " << answer.message);
    }
  }
}

/// The ghost goes when the arm is where it stood.
void PostureGoals::follow(double now) {
  if (phase_ != Phase::kGoing) return;
  if (goal_.way(input_.history().newest()) < kArrived || now > end_of_way_ + kOverdue) forget();
}

void PostureGoals::move_handles() {
  const std::vector<Pose> X_WL = skeleton_.poses(goal_.posture(input_.history().newest()));
  for (std::size_t link = 1; link < X_WL.size(); ++link) {
    const SkeletonLink& child = skeleton_.links()[link];
    if (child.joint.kind == JointKind::kFixed || link == dragged_) continue;
    server_.setPose(child.name, message_of(handle_pose(child.joint, X_WL[link])));
  }
  server_.applyChanges();
}

std::string PostureGoals::remark() const {
  switch (phase_) {
    case Phase::kAsking:
    case Phase::kGoing:
      return "on the way";
    case Phase::kRefused:
      return "refused: " + answer_;
    case Phase::kPlanning:
      break;
  }
  for (const auto& [link, asked] : goal_.asked()) {
    if (asked.at_stop) return skeleton_.links()[link].joint.name + ": at its stop";
  }
  return "right-click a ring: go there";
}

void PostureGoals::draw_ghost() {
  const std::vector<Pose> X_WL = skeleton_.poses(goal_.posture(input_.history().newest()));
  const auto& asked = goal_.asked();
  const bool at_stop = std::any_of(asked.begin(), asked.end(),
                                   [](const auto& entry) { return entry.second.at_stop; });
  const bool bad = phase_ == Phase::kRefused || (phase_ == Phase::kPlanning && at_stop);
  const auto colour = bad                          ? colour_of(1.0, 0.3, 0.2, 0.5)
                      : phase_ == Phase::kPlanning ? colour_of(0.4, 0.7, 1.0, 0.5)
                                                   : colour_of(0.3, 0.9, 0.4, 0.5);
  visualization_msgs::MarkerArray ghost;
  ghost.markers = ghost_of(skeleton_, X_WL, colour);
  const std::size_t last = asked.rbegin()->first;
  ghost.markers.push_back(text_at(skeleton_.links()[0].name, "remark",
                                  X_WL[last] * skeleton_.links()[last].middle, remark()));
  ghost_.publish(ghost);
}

// ---- whether there is a controller

void PostureGoals::survey(double now) {
  if (now < next_survey_) return;
  next_survey_ = now + kSearchPeriod;
  constexpr double kNever = 1e9;  // the master may not answer
  calls_.start(
      kSearch,
      [service = nh_.resolveName(kGoTo)] {
        return CallResult{kSearch, ros::service::exists(service, false), {}};
      },
      kNever, now);
}

void PostureGoals::offer() {
  offered_ = true;
  for (const SkeletonLink& link : skeleton_.links()) {
    if (link.joint.kind == JointKind::kFixed) continue;
    server_.insert(joint_handle(skeleton_.links()[0].name, link),
                   [this](const auto& feedback) { hear(*feedback); });
    menu_.apply(server_, link.name);
  }
  server_.applyChanges();
}

void PostureGoals::withdraw() {
  offered_ = false;
  forget();
  server_.clear();
  server_.applyChanges();
}

}  // namespace anthrob
