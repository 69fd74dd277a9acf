#include "link_pulls.h"

#include <visualization_msgs/MarkerArray.h>

#include <cmath>

#include "anthrob_core/monotonic_clock.h"
#include "marker_messages.h"

namespace anthrob {
namespace {

constexpr double kDuration = 0.2;      // [s] simulated: then a push ends by itself
constexpr double kRenewal = 0.004;     // [s] of the robot's time
constexpr double kPicture = 0.03;      // [s] between two arrows
constexpr double kSurveyPeriod = 2.0;  // [s] between two questions to the master
constexpr double kPatience = 5.0;      // [s] until it is told that nothing can be pushed
const char* const kApplyWrench = "sim/apply_wrench";

Vec3 vector_from(const geometry_msgs::Point& point) {
  return {point.x, point.y, point.z};
}

}  // namespace

LinkPulls::LinkPulls(ros::NodeHandle& nh, const Skeleton& skeleton, const PostureInput& input,
                     const PullSpring& spring)
    : nh_(nh),
      skeleton_(skeleton),
      input_(input),
      spring_(spring),
      server_("push"),
      arrows_(nh_.advertise<visualization_msgs::MarkerArray>("push/force", 10)),
      begun_(monotonic_now()) {}

// ---- what the window says

void LinkPulls::hear(const Feedback& feedback) {
  const auto link = skeleton_.find(feedback.marker_name);
  if (!link || input_.history().empty()) return;
  if (!vector_from(feedback.pose.position).allFinite()) return;
  if (feedback.event_type == Feedback::MOUSE_DOWN) return grab(*link, feedback);
  const auto held = held_.find(feedback.marker_name);
  if (held == held_.end()) return;
  switch (feedback.event_type) {
    case Feedback::POSE_UPDATE:
      return move(held->second, feedback);
    case Feedback::KEEP_ALIVE:
      return held->second.drag.hear(monotonic_now());
    case Feedback::MOUSE_UP:
      return release(feedback.marker_name);
    default:
      return;
  }
}

void LinkPulls::grab(std::size_t link, const Feedback& feedback) {
  const Vec3 clicked = vector_from(feedback.mouse_point);
  const bool known = feedback.mouse_point_valid && clicked.allFinite();
  const Vec3 point_L = known ? clicked : skeleton_.links()[link].middle;
  const Vec3 mouse_W = skeleton_.pose(link, input_.history().newest()) * point_L;
  release(feedback.marker_name);
  held_.emplace(feedback.marker_name, Held{link, vector_from(feedback.pose.position),
                                           Drag(point_L, mouse_W, monotonic_now())});
}

void LinkPulls::move(Held& held, const Feedback& feedback) {
  // The window saw the link where it was some time ago.
  const ros::Time& seen = feedback.header.stamp;
  const PostureHistory& history = input_.history();
  const Posture& posture = seen.isZero() ? history.newest() : history.at(seen.toSec());
  const Vec3 moved_L = vector_from(feedback.pose.position) - held.marker_L;
  held.drag.move(skeleton_.pose(held.link, posture) * (held.drag.point_L() + moved_L),
                 monotonic_now());
}

// ---- what the robot gets

void LinkPulls::renew() {
  if (held_.empty()) return;
  const double time = input_.history().newest_time();
  if (time >= renewed_ && time < renewed_ + kRenewal) return;
  renewed_ = time;
  period_.renewed(time);
  const auto held = held_;  // a call that fails ends them
  for (const auto& [name, link] : held) {
    if (held_.count(name) > 0 && !link.drag.abandoned(monotonic_now())) renew(link);
  }
}

void LinkPulls::renew(const Held& held) {
  const PostureHistory& history = input_.history();
  const Vec3& point_L = held.drag.point_L();
  const Vec3 grabbed_W = skeleton_.pose(held.link, history.newest()) * point_L;
  const Pull pull = pull_of(softened(spring_, period_.mean()), grabbed_W,
                            history.velocity(skeleton_, held.link, point_L), held.drag.mouse_W());
  const SkeletonLink& link = skeleton_.links()[held.link];
  if (!apply(link, point_L, pull.force_W, kDuration)) return;
  const double now = monotonic_now();
  if (now < drawn_ + kPicture) return;
  drawn_ = now;
  visualization_msgs::MarkerArray arrows;
  arrows.markers =
      arrow_of(skeleton_.links()[0].name, link.name, grabbed_W, held.drag.mouse_W(), pull);
  arrows_.publish(arrows);
}

void LinkPulls::release(const std::string& name) {
  const auto found = held_.find(name);
  if (found == held_.end()) return;
  const Held held = found->second;
  held_.erase(found);
  apply(skeleton_.links()[held.link], held.drag.point_L(), Vec3::Zero(), 0.0);
  if (!offered_) return;
  server_.setPose(name, message_of(Pose()));  // back onto the link
  server_.applyChanges();
  visualization_msgs::MarkerArray arrows;
  arrows.markers = erased_arrow(skeleton_.links()[0].name, name);
  arrows_.publish(arrows);
}

/// @param duration simulated [s]   @return false if there is nobody to push any more
bool LinkPulls::apply(const SkeletonLink& link, const Vec3& point_L, const Vec3& force_W,
                      double duration) {
  anthrob_msgs::ApplyWrench push;
  push.request.link = link.name;
  push.request.point = point_of(point_L);
  push.request.force.x = force_W.x();
  push.request.force.y = force_W.y();
  push.request.force.z = force_W.z();
  push.request.duration = ros::Duration(duration);
  if (!apply_wrench_.isValid()) {
    apply_wrench_ = nh_.serviceClient<anthrob_msgs::ApplyWrench>(kApplyWrench, true);
  }
  if (!apply_wrench_.call(push)) {
    withdraw();
    return false;
  }
  if (!push.response.success) {
    ROS_WARN_STREAM_THROTTLE(1.0, kApplyWrench << ": " << push.response.message);
  }
  return push.response.success;
}

// ---- whether there is anything to push

void LinkPulls::look() {
  const double now = monotonic_now();
  const auto held = held_;
  for (const auto& [name, link] : held) {
    if (!link.drag.abandoned(now)) continue;
    ROS_WARN_STREAM(name << ": released: RViz has not said for " << Drag::kSilence
                         << " s that the mouse still holds it");
    release(name);
  }
  if (!offered_ && now >= next_survey_) survey();
}

void LinkPulls::survey() {
  const double now = monotonic_now();
  next_survey_ = now + kSurveyPeriod;
  const std::string service = nh_.resolveName(kApplyWrench);
  if (ros::service::exists(service, false)) return offer();
  if (told_ || now < begun_ + kPatience) return;
  told_ = true;
  ROS_INFO_STREAM("no service " << service
                                << ": links cannot be pushed by the mouse; only the simulator has "
                                   "it");
}

void LinkPulls::offer() {
  offered_ = true;
  for (const SkeletonLink& link : skeleton_.links()) {
    if (!link.moves) continue;
    server_.insert(pullable(link), [this](const auto& feedback) { hear(*feedback); });
  }
  server_.applyChanges();
}

void LinkPulls::withdraw() {
  if (!offered_) return;
  offered_ = false;
  ROS_WARN_STREAM("no answer from " << nh_.resolveName(kApplyWrench)
                                    << ": links cannot be pushed until it is there again");
  held_.clear();
  server_.clear();
  server_.applyChanges();
}

}  // namespace anthrob
